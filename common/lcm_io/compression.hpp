#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace limbcast::lcm_io {

/// zstd, at a level that keeps up with a camera.
std::vector<std::uint8_t> compress(const std::vector<std::uint8_t>& bytes);

/// The bytes again. Throws MessageError unless the frame is sound and holds exactly `expected_size`
/// bytes.
std::vector<std::uint8_t> decompress(const std::vector<std::uint8_t>& frame,
                                     std::size_t expected_size);

/// A lattice of 16-bit values, row by row, lossless: residuals to the median predictor (Weinberger,
/// Seroussi, Sapiro: "The LOCO-I lossless image compression algorithm", IEEE Trans. Image
/// Processing 9, 2000), zigzag coded, low bytes first, then high bytes, zstd.
std::vector<std::uint8_t> encode_lattice(const std::vector<std::uint16_t>& values, int width,
                                         int height);
std::vector<std::uint16_t> decode_lattice(const std::vector<std::uint8_t>& bytes, int width,
                                          int height);

/// A sequence of 16-bit values, lossless: zigzag-coded differences, low bytes first, then high
/// bytes, zstd.
std::vector<std::uint8_t> encode_sequence(const std::vector<std::int16_t>& values);
std::vector<std::int16_t> decode_sequence(const std::vector<std::uint8_t>& bytes,
                                          std::size_t count);

}  // namespace limbcast::lcm_io
