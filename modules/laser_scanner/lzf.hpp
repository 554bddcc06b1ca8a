#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace limbcast::laser_scanner {

/// Unpacks LZF (Marc Lehmann's LibLZF, as PCL packs binary_compressed files): `size` bytes, or
/// nothing where the data are torn.
std::optional<std::vector<std::uint8_t>> unpack_lzf(const std::uint8_t* data, std::size_t data_size,
                                                    std::size_t size);

}  // namespace limbcast::laser_scanner
