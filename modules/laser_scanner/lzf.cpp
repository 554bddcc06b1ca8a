#include "modules/laser_scanner/lzf.hpp"

namespace limbcast::laser_scanner {

std::optional<std::vector<std::uint8_t>> unpack_lzf(const std::uint8_t* data, std::size_t data_size,
                                                    std::size_t size) {
  constexpr std::size_t kLiteralBelow = 32;  // control byte: 000LLLLL, then L + 1 bytes as they are
  constexpr std::size_t kLongLength = 7;  // else LLLooooo [LLLLLLLL] oooooooo: repeat L + 2 bytes
  std::vector<std::uint8_t> out;
  out.reserve(size);
  std::size_t in = 0;
  while (in < data_size) {
    const std::size_t control = data[in++];
    if (control < kLiteralBelow) {
      const std::size_t length = control + 1;
      if (in + length > data_size || out.size() + length > size) return std::nullopt;
      out.insert(out.end(), data + in, data + in + length);
      in += length;
      continue;
    }
    std::size_t length = control >> 5U;
    if (length == kLongLength) {
      if (in >= data_size) return std::nullopt;
      length += data[in++];
    }
    if (in >= data_size) return std::nullopt;
    const std::size_t distance = ((control & 0x1FU) << 8U) + data[in++] + 1;
    length += 2;
    if (distance > out.size() || out.size() + length > size) return std::nullopt;
    // The repeated bytes may overlap those that are being written.
    for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - distance]);
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

}  // namespace limbcast::laser_scanner
