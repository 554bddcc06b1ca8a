#include "modules/calibrate/output.hpp"

#include <boost/crc.hpp>
#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "common/whole_file.hpp"

namespace limbcast::calibrate {
namespace {

void append_big_endian(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

/// PNG's chunk pHYs (PNG specification, 11.3.5.3), which OpenCV does not write.
std::vector<std::uint8_t> resolution_chunk(double pixels_per_m) {
  constexpr std::uint8_t kUnitMetre = 1;
  std::vector<std::uint8_t> body = {'p', 'H', 'Y', 's'};
  const auto resolution = static_cast<std::uint32_t>(std::lround(pixels_per_m));
  append_big_endian(body, resolution);
  append_big_endian(body, resolution);
  body.push_back(kUnitMetre);
  boost::crc_32_type checksum;
  checksum.process_bytes(body.data(), body.size());
  std::vector<std::uint8_t> chunk;
  append_big_endian(chunk, static_cast<std::uint32_t>(body.size()) - 4);
  chunk.insert(chunk.end(), body.begin(), body.end());
  append_big_endian(chunk, checksum.checksum());
  return chunk;
}

}  // namespace

void write_png_of_size(const std::string& path, const cv::Mat& image, double pixels_per_m) {
  // The chunk must follow the signature and IHDR, whose size is fixed.
  constexpr std::ptrdiff_t kHeaderBytes = 8 + 25;
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  const std::vector<std::uint8_t> chunk = resolution_chunk(pixels_per_m);
  bytes.insert(bytes.begin() + kHeaderBytes, chunk.begin(), chunk.end());
  write_whole_file(path, bytes);
}

}  // namespace limbcast::calibrate
