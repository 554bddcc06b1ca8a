#include "common/lcm_io/compression.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>

#include "common/lcm_io/message_error.hpp"
#include "common/simd.hpp"

namespace limbcast::lcm_io {
namespace {

/// Entropy coding does nearly all the work on residuals; level 1 is within 2 % of level 3 at half
/// the time.
constexpr int kZstdLevel = 1;

/// Rows of a lattice that are decoded together: within a row each value waits for the one before,
/// and meanwhile the processor does the other rows'.
constexpr int kRowsAtOnce = 4;

/// Small magnitudes of either sign to small numbers: 0 -1 1 -2 2 ... -> 0 1 2 3 4 ...; modulo 2^16.
std::uint16_t zigzag(std::uint16_t residual) {
  const auto negative = static_cast<std::uint16_t>(-(residual >> 15));
  return static_cast<std::uint16_t>(static_cast<std::uint16_t>(residual << 1) ^ negative);
}

std::uint16_t unzigzag(std::uint16_t code) {
  return static_cast<std::uint16_t>((code >> 1) ^ -(code & 1));
}

/// Value expected from the left, the upper and the upper left neighbour: the median of the first
/// two and of left + up - up_left, written so that nothing exceeds 16 bits.
template <typename Number>
Number predict(Number left, Number up, Number up_left) {
  return static_cast<Number>(left + up -
                             std::clamp(up_left, std::min(left, up), std::max(left, up)));
}

/// Codes on their way to or from zstd: all low bytes, then all high bytes.
class Planes {
 public:
  explicit Planes(std::size_t count) : bytes_(count * 2) {}
  explicit Planes(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}
  std::uint8_t* low() { return bytes_.data(); }
  std::uint8_t* high() { return bytes_.data() + bytes_.size() / 2; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

void write_code(std::uint16_t residual, std::uint8_t& low, std::uint8_t& high) {
  const std::uint16_t code = zigzag(residual);
  low = static_cast<std::uint8_t>(code & 0xFF);
  high = static_cast<std::uint8_t>(code >> 8);
}

/// Of a sequence, or of the first row or column of a lattice, whose values are `step` apart.
void write_differences(const std::uint16_t* values, std::size_t count, std::size_t step,
                       std::uint8_t* low, std::uint8_t* high) {
  std::uint16_t previous = 0;
  for (std::size_t i = 0; i < count * step; i += step) {
    write_code(static_cast<std::uint16_t>(values[i] - previous), low[i], high[i]);
    previous = values[i];
  }
}

/// Of a row but for its first value.
LIMBCAST_SIMD void write_residuals(const std::uint16_t* __restrict row,
                                   const std::uint16_t* __restrict above, int width,
                                   std::uint8_t* __restrict low, std::uint8_t* __restrict high) {
  for (int u = 1; u < width; ++u) {
    const std::uint16_t expected = predict(row[u - 1], above[u], above[u - 1]);
    write_code(static_cast<std::uint16_t>(row[u] - expected), low[u], high[u]);
  }
}

LIMBCAST_SIMD void read_residuals(const std::uint8_t* __restrict low,
                                  const std::uint8_t* __restrict high, std::size_t count,
                                  std::uint16_t* __restrict residuals) {
  for (std::size_t i = 0; i < count; ++i)
    residuals[i] = unzigzag(static_cast<std::uint16_t>(low[i] | (high[i] << 8)));
}

std::vector<std::uint16_t> residuals_of(const std::vector<std::uint8_t>& bytes, std::size_t count) {
  Planes planes(decompress(bytes, count * 2));
  std::vector<std::uint16_t> residuals(count);
  read_residuals(planes.low(), planes.high(), count, residuals.data());
  return residuals;
}

/// Residuals of a sequence, or of the first row or column of a lattice, to its values.
void add_up(std::uint16_t* values, std::size_t count, std::size_t step) {
  std::uint16_t previous = 0;
  for (std::size_t i = 0; i < count * step; i += step) {
    values[i] = static_cast<std::uint16_t>(values[i] + previous);
    previous = values[i];
  }
}

/// Residuals of rows below a known one, and whose first values are known, to values: each row is
/// one pixel behind the one above.
template <int num_rows>
void add_predictions(std::uint16_t* rows, int width) {
  const std::uint16_t* above = rows - width;
  std::array<int, num_rows> last{}, last_but_one{};  // of each row
  for (int i = 0; i < num_rows; ++i) last[i] = rows[static_cast<std::ptrdiff_t>(i) * width];
  for (int first_row_u = 1; first_row_u < width + num_rows - 1; ++first_row_u) {
    for (int i = num_rows - 1; i >= 0; --i) {
      const int u = first_row_u - i;
      if (u < 1 || u >= width) continue;
      const int up = i == 0 ? above[u] : last[i - 1];
      const int up_left = i == 0 ? above[u - 1] : last_but_one[i - 1];
      std::uint16_t& value = rows[static_cast<std::ptrdiff_t>(i) * width + u];
      value = static_cast<std::uint16_t>(value + predict(last[i], up, up_left));
      last_but_one[i] = last[i];
      last[i] = value;
    }
  }
}

}  // namespace

std::vector<std::uint8_t> compress(const std::vector<std::uint8_t>& bytes) {
  const std::size_t room = ZSTD_compressBound(bytes.size());
  // Not a vector, which would clear it all: most of it is never written.
  const std::unique_ptr<std::uint8_t[]> frame(new std::uint8_t[room]);
  const std::size_t size = ZSTD_compress(frame.get(), room, bytes.data(), bytes.size(), kZstdLevel);
  return {frame.get(), frame.get() + size};
}

std::vector<std::uint8_t> decompress(const std::vector<std::uint8_t>& frame,
                                     std::size_t expected_size) {
  require(ZSTD_getFrameContentSize(frame.data(), frame.size()) == expected_size,
          "compressed data has another size than the message says");
  std::vector<std::uint8_t> bytes(expected_size);
  const std::size_t size = ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size());
  require(ZSTD_isError(size) == 0 && size == expected_size, "compressed data is damaged");
  return bytes;
}

std::vector<std::uint8_t> encode_lattice(const std::vector<std::uint16_t>& values, int width,
                                         int height) {
  if (values.empty()) return compress({});
  Planes planes(values.size());
  write_differences(values.data(), height, width, planes.low(), planes.high());
  write_differences(values.data(), width, 1, planes.low(), planes.high());
  for (int v = 1; v < height; ++v) {
    const std::size_t at = static_cast<std::size_t>(v) * width;
    const std::uint16_t* row = values.data() + at;
    write_residuals(row, row - width, width, planes.low() + at, planes.high() + at);
  }
  return compress(planes.bytes());
}

std::vector<std::uint16_t> decode_lattice(const std::vector<std::uint8_t>& bytes, int width,
                                          int height) {
  std::vector<std::uint16_t> values = residuals_of(bytes, static_cast<std::size_t>(width) * height);
  if (values.empty()) return values;
  add_up(values.data(), width, 1);
  add_up(values.data(), height, width);
  int v = 1;
  const auto row = [&] { return values.data() + static_cast<std::size_t>(v) * width; };
  for (; v + kRowsAtOnce <= height; v += kRowsAtOnce) add_predictions<kRowsAtOnce>(row(), width);
  for (; v < height; ++v) add_predictions<1>(row(), width);
  return values;
}

std::vector<std::uint8_t> encode_sequence(const std::vector<std::int16_t>& values) {
  const std::vector<std::uint16_t> unsigned_values(values.begin(), values.end());
  Planes planes(values.size());
  write_differences(unsigned_values.data(), values.size(), 1, planes.low(), planes.high());
  return compress(planes.bytes());
}

std::vector<std::int16_t> decode_sequence(const std::vector<std::uint8_t>& bytes,
                                          std::size_t count) {
  std::vector<std::uint16_t> values = residuals_of(bytes, count);
  add_up(values.data(), count, 1);
  return {values.begin(), values.end()};
}

}  // namespace limbcast::lcm_io
