#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "modules/laser_scanner/cloud_file.hpp"

namespace limbcast::laser_scanner {

enum class NumberKind : std::uint8_t { kFloat, kSigned, kUnsigned };

/// One column of a table of points.
struct Column {
  std::string name;
  NumberKind kind = NumberKind::kFloat;
  int size = 4;   ///< bytes of one number
  int count = 1;  ///< numbers of one point
};

/// A table of points as PCD and PLY hold it.
struct PointTable {
  std::vector<Column> columns;
  std::size_t num_points = 0;

  std::size_t row_bytes() const;
};

/// Points of a table whose rows stand one after the other, as numbers of the machine. Throws
/// InputError where x, y or z is missing or bytes are.
RawCloud points_of_rows(const PointTable& table, const std::vector<std::uint8_t>& bytes,
                        const std::string& where);

/// Rows in the machine's numbers from text, a line each; what follows them is not read. Throws
/// InputError where a line holds other than as many numbers as a row has, but for one in which the
/// text ends, and for a number that does not fit its column; where points have no use for that
/// column, it is 0 instead.
std::vector<std::uint8_t> rows_of_text(const PointTable& table, const std::string& text,
                                       const std::string& where);

}  // namespace limbcast::laser_scanner
