#include "modules/laser_scanner/cloud_file.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>

#include "common/file_extension.hpp"
#include "common/input_error.hpp"
#include "modules/laser_scanner/lzf.hpp"
#include "modules/laser_scanner/point_table.hpp"

namespace limbcast::laser_scanner {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& found) {
  throw InputError(path + ": " + found + "; copy it again or convert it to PCD");
}

std::string read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw InputError(path + ": cannot be read; check that it exists and may be read");
  return bytes;
}

/// The header's next line as words; moves `at` behind it.
std::vector<std::string> next_line(const std::string& bytes, std::size_t& at,
                                   const std::string& path) {
  const std::size_t end = bytes.find('\n', at);
  if (end == std::string::npos) fail(path, "its header does not end");
  std::istringstream line(bytes.substr(at, end - at));
  at = end + 1;
  return {std::istream_iterator<std::string>(line), {}};
}

std::size_t read_count(const std::string& word, const std::string& path) {
  char* end = nullptr;
  const unsigned long long count = std::strtoull(word.c_str(), &end, 10);
  // As the formats' own libraries count; two of them can be multiplied.
  constexpr auto kLargestCount = std::numeric_limits<std::uint32_t>::max();
  if (word.empty() || *end != '\0' || count > kLargestCount)
    fail(path, "tells '" + word + "' points");
  return count;
}

void check_num_points(const PointTable& table, std::size_t max_points, const std::string& path) {
  if (table.num_points <= max_points) return;
  throw InputError(path + ": holds " + std::to_string(table.num_points) +
                   " points, more than the " + std::to_string(max_points) +
                   " that can be sent; thin it out or cut it in pieces");
}

struct PcdHeader {
  PointTable table;
  std::optional<std::size_t> num_points, width;
  std::size_t height = 1;
  std::string data;  ///< ascii, binary or binary_compressed
};

/// FIELDS comes first and gives the columns; SIZE, TYPE and COUNT fill them.
void read_pcd_line(const std::vector<std::string>& words, PcdHeader& header,
                   const std::string& path) {
  std::vector<Column>& columns = header.table.columns;
  const std::string& key = words[0];
  if (key == "FIELDS") columns.resize(words.size() - 1);
  if (key == "POINTS" && words.size() > 1) header.num_points = read_count(words[1], path);
  if (key == "WIDTH" && words.size() > 1) header.width = read_count(words[1], path);
  if (key == "HEIGHT" && words.size() > 1) header.height = read_count(words[1], path);
  if (key == "DATA" && words.size() > 1) header.data = words[1];
  if (key != "FIELDS" && key != "SIZE" && key != "TYPE" && key != "COUNT") return;
  if (words.size() != columns.size() + 1) fail(path, "its header's " + key + " has another length");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& word = words[i + 1];
    if (key == "FIELDS") columns[i].name = word;
    if (key == "SIZE") columns[i].size = static_cast<int>(read_count(word, path));
    if (key == "COUNT") columns[i].count = static_cast<int>(read_count(word, path));
    if (key == "TYPE") {
      columns[i].kind = word == "F"   ? NumberKind::kFloat
                        : word == "I" ? NumberKind::kSigned
                                      : NumberKind::kUnsigned;
    }
  }
}

void check_pcd_column(const Column& column, const std::string& path) {
  const bool size_right =
      column.size == 1 || column.size == 2 || column.size == 4 || column.size == 8;
  if (!size_right || column.count < 1 || column.count > 4096) fail(path, "its header is no PCD's");
  if (column.kind == NumberKind::kFloat && column.size < 4) {
    throw InputError(path + ": its field '" + column.name + "' is a float of " +
                     std::to_string(column.size) + " bytes; write it with 4 or 8");
  }
}

/// POINTS must be WIDTH x HEIGHT, as PCL wants it too: else it is open how many rows follow. HEIGHT
/// 0 is PCL's for a list of points.
std::size_t num_pcd_points(const PcdHeader& header, const std::string& path) {
  if (!header.width) return *header.num_points;
  const std::size_t height = std::max<std::size_t>(header.height, 1);
  const std::size_t in_lattice = *header.width * height;
  if (header.num_points.value_or(in_lattice) == in_lattice) return in_lattice;
  throw InputError(path + ": its header tells POINTS " + std::to_string(*header.num_points) +
                   " but WIDTH " + std::to_string(*header.width) + " x HEIGHT " +
                   std::to_string(height) + "; write it again or correct its header");
}

PcdHeader read_pcd_header(const std::string& bytes, std::size_t& at, const std::string& path) {
  PcdHeader header;
  while (header.data.empty()) {
    const std::vector<std::string> words = next_line(bytes, at, path);
    if (!words.empty()) read_pcd_line(words, header, path);
  }
  for (const Column& column : header.table.columns) check_pcd_column(column, path);
  if (header.table.columns.empty()) fail(path, "its header names no fields");
  if (!header.num_points && !header.width) fail(path, "its header does not tell how many points");
  header.table.num_points = num_pcd_points(header, path);
  return header;
}

/// binary_compressed holds column after column; we read row after row.
std::vector<std::uint8_t> rows_of_columns(const PointTable& table,
                                          const std::vector<std::uint8_t>& columns) {
  std::vector<std::uint8_t> rows(columns.size());
  std::size_t column_start = 0;
  std::size_t offset = 0;
  for (const Column& column : table.columns) {
    const std::size_t size =
        static_cast<std::size_t>(column.size) * static_cast<std::size_t>(column.count);
    for (std::size_t i = 0; i < table.num_points; ++i) {
      std::memcpy(&rows[i * table.row_bytes() + offset], &columns[column_start + i * size], size);
    }
    column_start += size * table.num_points;
    offset += size;
  }
  return rows;
}

std::vector<std::uint8_t> unpack_pcd(const PointTable& table, const std::string& bytes,
                                     std::size_t at, const std::string& path) {
  std::uint32_t packed_size = 0;
  std::uint32_t size = 0;
  if (bytes.size() < at + 8) fail(path, "is torn");
  std::memcpy(&packed_size, &bytes[at], 4);
  std::memcpy(&size, &bytes[at + 4], 4);
  if (bytes.size() < at + 8 + packed_size || size != table.row_bytes() * table.num_points) {
    fail(path, "is torn");
  }
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data()) + at + 8;
  const auto columns = unpack_lzf(data, packed_size, size);
  if (!columns) fail(path, "its compressed data are torn");
  return rows_of_columns(table, *columns);
}

RawCloud read_pcd(const std::string& bytes, std::size_t max_points, const std::string& path) {
  std::size_t at = 0;
  const PcdHeader header = read_pcd_header(bytes, at, path);
  check_num_points(header.table, max_points, path);
  std::vector<std::uint8_t> rows;
  if (header.data == "ascii") {
    rows = rows_of_text(header.table, bytes.substr(at), path);
  } else if (header.data == "binary") {
    rows.assign(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end());
  } else if (header.data == "binary_compressed") {
    rows = unpack_pcd(header.table, bytes, at, path);
  } else {
    fail(path, "its data are '" + header.data + "', not ascii, binary or binary_compressed");
  }
  return points_of_rows(header.table, rows, path);
}

Column ply_column(const std::string& type, const std::string& name, const std::string& path) {
  struct Type {
    const char *name, *sized_name;
    NumberKind kind;
    int size;
  };
  static constexpr Type kTypes[] = {
      {"float", "float32", NumberKind::kFloat, 4},    {"double", "float64", NumberKind::kFloat, 8},
      {"uchar", "uint8", NumberKind::kUnsigned, 1},   {"char", "int8", NumberKind::kSigned, 1},
      {"ushort", "uint16", NumberKind::kUnsigned, 2}, {"short", "int16", NumberKind::kSigned, 2},
      {"uint", "uint32", NumberKind::kUnsigned, 4},   {"int", "int32", NumberKind::kSigned, 4}};
  for (const Type& known : kTypes) {
    if (type == known.name || type == known.sized_name) return {name, known.kind, known.size, 1};
  }
  fail(path, "has a property of type '" + type + "'");
}

RawCloud read_ply(const std::string& bytes, std::size_t max_points, const std::string& path) {
  PointTable table;
  std::string format;
  bool in_vertices = false;
  bool first_element = true;
  std::size_t at = 0;
  for (auto words = next_line(bytes, at, path); words.empty() || words[0] != "end_header";
       words = next_line(bytes, at, path)) {
    if (words.size() >= 2 && words[0] == "format") format = words[1];
    if (words.size() >= 3 && words[0] == "element") {
      in_vertices = words[1] == "vertex";
      if (in_vertices && !first_element) fail(path, "its points do not come first");
      if (in_vertices) table.num_points = read_count(words[2], path);
      first_element = false;
    }
    if (words.size() >= 3 && words[0] == "property" && in_vertices) {
      table.columns.push_back(ply_column(words[1], words[2], path));
    }
  }
  if (table.columns.empty()) fail(path, "has no points");
  check_num_points(table, max_points, path);
  if (format == "ascii")
    return points_of_rows(table, rows_of_text(table, bytes.substr(at), path), path);
  if (format != "binary_little_endian") fail(path, "its format is '" + format + "'");
  return points_of_rows(table, {bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end()},
                        path);
}

RawCloud read_kitti(const std::string& bytes, std::size_t max_points, const std::string& path) {
  const PointTable table{{{"x", NumberKind::kFloat, 4, 1},
                          {"y", NumberKind::kFloat, 4, 1},
                          {"z", NumberKind::kFloat, 4, 1},
                          {"intensity", NumberKind::kFloat, 4, 1}},
                         bytes.size() / 16};
  if (extension_of(std::filesystem::path(path).stem()) == ".pcd") {
    throw InputError(path +
                     ": is called like nuScenes' clouds, of five numbers a point where "
                     "KITTI's have four; convert it to PCD or KITTI .bin");
  }
  if (bytes.size() % table.row_bytes() != 0) {
    throw InputError(path +
                     ": is torn or not KITTI's, no multiple of 16 bytes (x, y, z and "
                     "intensity as floats); copy it again or convert it to PCD");
  }
  check_num_points(table, max_points, path);
  RawCloud cloud = points_of_rows(table, {bytes.begin(), bytes.end()}, path);
  // Rows of another length put coordinates where the intensities are.
  const bool are_rows = std::all_of(cloud.intensities.begin(), cloud.intensities.end(),
                                    [](float intensity) { return intensity >= 0.0F; });
  if (!are_rows) {
    throw InputError(path +
                     ": is not KITTI's, its fourth numbers are no intensities (some are negative); "
                     "convert it to PCD or KITTI .bin");
  }
  return cloud;
}

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

}  // namespace

RawCloud read_cloud_file(const std::string& path, std::size_t max_points) {
  const std::string bytes = read_bytes(path);
  if (bytes.empty()) fail(path, "is empty");
  if (starts_with(bytes, "ply\n") || starts_with(bytes, "ply\r")) {
    return read_ply(bytes, max_points, path);
  }
  if (starts_with(bytes, "# .PCD") || starts_with(bytes, "VERSION")) {
    return read_pcd(bytes, max_points, path);
  }
  if (extension_of(path) == ".bin") return read_kitti(bytes, max_points, path);
  fail(path, "is neither PCD, PLY nor KITTI .bin");
}

}  // namespace limbcast::laser_scanner
