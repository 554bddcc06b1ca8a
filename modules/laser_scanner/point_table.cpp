#include "modules/laser_scanner/point_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "common/formatted.hpp"
#include "common/input_error.hpp"

namespace limbcast::laser_scanner {
namespace {

/// Where a column starts in a row.
struct Place {
  std::size_t offset;
  const Column* column;
};

std::optional<Place> find(const PointTable& table, const std::vector<std::string>& names) {
  std::size_t offset = 0;
  for (const Column& column : table.columns) {
    for (const std::string& name : names) {
      if (column.name == name) return Place{offset, &column};
    }
    offset += static_cast<std::size_t>(column.size) * static_cast<std::size_t>(column.count);
  }
  return std::nullopt;
}

bool is_in(const std::optional<Place>& place, const Column& column) {
  return place && place->column == &column;
}

template <class T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <class T>
void store(double value, std::vector<std::uint8_t>& bytes) {
  const auto number = static_cast<T>(value);
  const auto* begin = reinterpret_cast<const std::uint8_t*>(&number);
  bytes.insert(bytes.end(), begin, begin + sizeof(T));
}

float read_number(const Place& place, const std::uint8_t* row) {
  const std::uint8_t* bytes = row + place.offset;
  const Column& column = *place.column;
  if (column.kind == NumberKind::kFloat) {
    return column.size == 8 ? static_cast<float>(load<double>(bytes)) : load<float>(bytes);
  }
  const bool is_signed = column.kind == NumberKind::kSigned;
  if (column.size == 1) return is_signed ? load<std::int8_t>(bytes) : load<std::uint8_t>(bytes);
  if (column.size == 2) return is_signed ? load<std::int16_t>(bytes) : load<std::uint16_t>(bytes);
  if (column.size == 4) {
    return is_signed ? static_cast<float>(load<std::int32_t>(bytes))
                     : static_cast<float>(load<std::uint32_t>(bytes));
  }
  return is_signed ? static_cast<float>(load<std::int64_t>(bytes))
                   : static_cast<float>(load<std::uint64_t>(bytes));
}

/// Packed colours use all 32 bits, with or without a sign.
bool fits(const Column& column, double value) {
  if (column.kind == NumberKind::kFloat) return true;
  const int bits = 8 * column.size;
  const bool may_be_negative = column.kind == NumberKind::kSigned || column.size == 4;
  const bool may_use_all_bits = column.kind == NumberKind::kUnsigned || column.size == 4;
  return value >= (may_be_negative ? -std::exp2(bits - 1) : 0.0) &&
         value < std::exp2(may_use_all_bits ? bits : bits - 1);
}

template <class Signed, class Unsigned>
void store_whole(double value, std::vector<std::uint8_t>& bytes) {
  value < 0.0 ? store<Signed>(value, bytes) : store<Unsigned>(value, bytes);
}

/// One that fits.
void store_number(const Column& column, double value, std::vector<std::uint8_t>& bytes) {
  if (column.kind == NumberKind::kFloat) {
    column.size == 8 ? store<double>(value, bytes) : store<float>(value, bytes);
  } else if (column.size == 1) {
    store_whole<std::int8_t, std::uint8_t>(value, bytes);
  } else if (column.size == 2) {
    store_whole<std::int16_t, std::uint16_t>(value, bytes);
  } else if (column.size == 4) {
    store_whole<std::int32_t, std::uint32_t>(value, bytes);
  } else {
    store_whole<std::int64_t, std::uint64_t>(value, bytes);
  }
}

/// One of a colour's channels, 0 to 255: as bytes, as whole numbers of 16 bits, or as shares of 1.
std::uint8_t read_channel(const Place& place, const std::uint8_t* row) {
  const Column& column = *place.column;
  const float full = column.kind == NumberKind::kFloat ? 1.0F
                     : column.size == 2                ? 65535.0F
                                                       : 255.0F;
  const float value = 255.0F * read_number(place, row) / full;
  return std::isfinite(value)
             ? static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)))
             : std::uint8_t{0};
}

/// Colours are packed as 0xAARRGGBB in one number (PCD) or stand as red, green, blue (PLY).
class ColorReader {
 public:
  explicit ColorReader(const PointTable& table)
      : packed_(find(table, {"rgb", "rgba"})),
        red_(find(table, {"red"})),
        green_(find(table, {"green"})),
        blue_(find(table, {"blue"})) {
    if (packed_ && packed_->column->size != 4) packed_.reset();
  }
  bool has_color() const { return packed_ || (red_ && green_ && blue_); }
  bool reads(const Column& column) const {
    if (packed_) return is_in(packed_, column);
    return has_color() && (is_in(red_, column) || is_in(green_, column) || is_in(blue_, column));
  }
  Bgr read(const std::uint8_t* row) const {
    if (packed_) return {row[packed_->offset], row[packed_->offset + 1], row[packed_->offset + 2]};
    return {read_channel(*blue_, row), read_channel(*green_, row), read_channel(*red_, row)};
  }

 private:
  std::optional<Place> packed_, red_, green_, blue_;
};

/// Where a row tells what is kept of a point. Intensities and rings as PCL, ROS drivers, PDAL and
/// CloudCompare name them.
struct PointPlaces {
  explicit PointPlaces(const PointTable& table)
      : x(find(table, {"x"})),
        y(find(table, {"y"})),
        z(find(table, {"z"})),
        color(table),
        intensity(find(
            table, {"intensity", "Intensity", "scalar_Intensity", "reflectivity", "reflectance"})),
        ring(find(table, {"ring", "scalar_ring", "laser_id"})) {}

  bool use(const Column& column) const {
    return is_in(x, column) || is_in(y, column) || is_in(z, column) || color.reads(column) ||
           is_in(intensity, column) || is_in(ring, column);
  }

  std::optional<Place> x, y, z;
  ColorReader color;
  std::optional<Place> intensity, ring;
};

/// What a ring's column holds; nothing for a point without a ring, as clouds put together have
/// them. Throws InputError where that is no number of a ring.
std::optional<std::uint16_t> read_ring(const Place& place, const std::uint8_t* row,
                                       const std::string& where) {
  const float ring = read_number(place, row);
  if (std::isnan(ring)) return std::nullopt;
  const bool is_number =
      ring >= 0.0F && ring <= std::numeric_limits<std::uint16_t>::max() && std::floor(ring) == ring;
  if (!is_number) {
    throw InputError(where + ": its column '" + place.column->name + "' holds " +
                     std::to_string(ring) + ", no number of a ring from 0 to 65535; rename it");
  }
  return static_cast<std::uint16_t>(ring);
}

/// The column of each number of a row.
std::vector<const Column*> columns_of_numbers(const PointTable& table) {
  std::vector<const Column*> columns;
  for (const Column& column : table.columns)
    columns.insert(columns.end(), static_cast<std::size_t>(column.count), &column);
  return columns;
}

[[noreturn]] void refuse_number(const Column& column, double number, std::size_t row,
                                const std::string& where) {
  throw InputError(
      formatted("%s: row %zu: '%s' is %.15g, its header tells whole numbers of %d bytes",
                where.c_str(), row, column.name.c_str(), number, column.size) +
      (column.kind == NumberKind::kUnsigned ? " without a sign" : "") + "; correct one of them");
}

/// Puts those between `begin` and `end` in place of what `numbers` holds.
void read_numbers(const std::string& text, std::size_t begin, std::size_t end,
                  const std::string& where, std::vector<double>& numbers) {
  constexpr const char* kBlank = " \t\f\v";
  numbers.clear();
  for (std::size_t at = text.find_first_not_of(kBlank, begin); at < end;
       at = text.find_first_not_of(kBlank, at)) {
    const std::size_t word_end = std::min(text.find_first_of(" \t\f\v\r\n", at), text.size());
    char* read_to = nullptr;
    numbers.push_back(std::strtod(&text[at], &read_to));
    if (read_to != &text[word_end]) {
      throw InputError(where + ": '" + text.substr(at, word_end - at) +
                       "' is no number; copy it again");
    }
    at = word_end;
  }
}

}  // namespace

std::size_t PointTable::row_bytes() const {
  std::size_t bytes = 0;
  for (const Column& column : columns) {
    bytes += static_cast<std::size_t>(column.size) * static_cast<std::size_t>(column.count);
  }
  return bytes;
}

RawCloud points_of_rows(const PointTable& table, const std::vector<std::uint8_t>& bytes,
                        const std::string& where) {
  const PointPlaces places(table);
  const auto& [x, y, z, color, intensity, ring] = places;
  if (!x || !y || !z) throw InputError(where + ": has no x, y and z; give a cloud of points");
  if (bytes.size() / table.row_bytes() < table.num_points) {
    throw InputError(where + ": is torn, holds fewer points than its header says; copy it again");
  }
  RawCloud cloud;
  bool all_have_rings = ring.has_value();
  for (std::size_t i = 0; i < table.num_points; ++i) {
    const std::uint8_t* row = bytes.data() + i * table.row_bytes();
    const Eigen::Vector3f point{read_number(*x, row), read_number(*y, row), read_number(*z, row)};
    if (!point.allFinite()) continue;
    cloud.points.push_back(point);
    if (color.has_color()) cloud.colors.push_back(color.read(row));
    if (intensity) {
      const float value = read_number(*intensity, row);
      cloud.intensities.push_back(std::isfinite(value) ? value : 0.0F);
    }
    if (!all_have_rings) continue;
    const auto number = read_ring(*ring, row, where);
    all_have_rings = number.has_value();
    cloud.rings.push_back(number.value_or(0));
  }
  if (!all_have_rings) cloud.rings.clear();
  return cloud;
}

std::vector<std::uint8_t> rows_of_text(const PointTable& table, const std::string& text,
                                       const std::string& where) {
  const PointPlaces places(table);
  const std::vector<const Column*> columns = columns_of_numbers(table);
  std::vector<std::uint8_t> bytes;
  std::vector<double> numbers;
  std::size_t row = 0;
  for (std::size_t begin = 0; row < table.num_points && begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    read_numbers(text, begin, end, where, numbers);
    const bool last = end == text.size();
    begin = end + 1;
    if (numbers.empty()) continue;
    ++row;
    // The row in which the text ends may be torn; that is told by its bytes.
    if (numbers.size() > columns.size() || (numbers.size() < columns.size() && !last)) {
      throw InputError(where + ": row " + std::to_string(row) + " holds " +
                       std::to_string(numbers.size()) + " numbers, its header tells " +
                       std::to_string(columns.size()) + "; write it again or correct it");
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const bool stays = fits(*columns[i], numbers[i]);
      if (!stays && places.use(*columns[i])) refuse_number(*columns[i], numbers[i], row, where);
      store_number(*columns[i], stays ? numbers[i] : 0.0, bytes);
    }
  }
  return bytes;
}

}  // namespace limbcast::laser_scanner
