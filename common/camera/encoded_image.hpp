#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace limbcast {

enum class ImageFormat : std::int8_t { kJpeg = 0, kPng = 1 };

/// A picture as a file or a message holds it.
struct EncodedImage {
  ImageFormat format = ImageFormat::kJpeg;
  int width = 0, height = 0;  ///< [px]
  int channels = 0;           ///< 1 grey, 3 colour
  int bits = 8;               ///< of one channel, 8 or 16
  std::vector<std::uint8_t> bytes;

  bool empty() const { return bytes.empty(); }
};

/// Reads a JPEG or PNG file without decoding its pixels: kind and size come from its header, its
/// end is checked. Throws InputError where it is none, or torn.
EncodedImage read_encoded_image(const std::string& path);
/// Same for bytes in memory; `where` names them in errors.
EncodedImage identify_image(std::vector<std::uint8_t> bytes, const std::string& where);

/// Throws InputError where a picture is not of 8 bit; `where` names it.
void check_8_bit(const EncodedImage& image, const std::string& where);

/// JPEG of an 8-bit grey or BGR image; `quality` 1 to 100.
EncodedImage encode_jpeg(const cv::Mat& image, int quality);
/// PNG of an 8- or 16-bit image, without loss.
EncodedImage encode_png(const cv::Mat& image);

/// Pixels as stored: grey or BGR, 8 or 16 bit. Throws InputError where they cannot be decoded.
cv::Mat decode_image(const EncodedImage& image, const std::string& where);
/// The same with colours turned into grey.
cv::Mat decode_grey(const EncodedImage& image, const std::string& where);

}  // namespace limbcast
