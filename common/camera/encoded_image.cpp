#include "common/camera/encoded_image.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "common/camera/jpeg.hpp"
#include "common/input_file.hpp"

namespace limbcast {
namespace {

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::array<std::uint8_t, 4> kPngEnd = {'I', 'E', 'N', 'D'};
constexpr std::array<std::uint8_t, 2> kJpegEnd = {0xFF, 0xD9};

[[noreturn]] void fail(const std::string& where, const std::string& found) {
  throw InputError(where + ": " + found + "; copy or record it again, or leave the frame out");
}

int big_endian_16(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return bytes[at] << 8 | bytes[at + 1];
}

int big_endian_32(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return big_endian_16(bytes, at) << 16 | big_endian_16(bytes, at + 2);
}

/// Start-of-frame markers carry the size (ISO/IEC 10918-1, Table B.1): C0 to CF but for the tables'
/// C4, C8, CC.
bool is_start_of_frame(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

EncodedImage identify_jpeg(std::vector<std::uint8_t> bytes, const std::string& where) {
  EncodedImage image;
  std::size_t at = 2;
  // Segments stand one after the other: FF, marker, length (which counts itself), data.
  while (at + 9 < bytes.size() && bytes[at] == 0xFF && bytes[at + 1] != 0xDA) {
    if (bytes[at + 1] == 0xFF) {  // padding
      ++at;
      continue;
    }
    if (is_start_of_frame(bytes[at + 1])) {
      image.bits = bytes[at + 4];
      image.height = big_endian_16(bytes, at + 5);
      image.width = big_endian_16(bytes, at + 7);
      image.channels = bytes[at + 9];
    }
    at += 2 + static_cast<std::size_t>(big_endian_16(bytes, at + 2));
  }
  if (image.width <= 0 || image.height <= 0 || at >= bytes.size()) fail(where, "is a torn JPEG");
  // In the coded pixels every FF is followed by 00 or a restart marker, so that FF D9 can only be
  // the end.
  const auto pixels = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  if (std::search(pixels, bytes.end(), kJpegEnd.begin(), kJpegEnd.end()) == bytes.end()) {
    fail(where, "is a torn JPEG (its end is missing)");
  }
  if (image.bits != 8 || (image.channels != 1 && image.channels != 3)) {
    fail(where, "is a JPEG of " + std::to_string(image.channels) + " channels of " +
                    std::to_string(image.bits) + " bit, grey or colour of 8 bit expected");
  }
  image.bytes = std::move(bytes);
  return image;
}

EncodedImage identify_png(std::vector<std::uint8_t> bytes, const std::string& where) {
  EncodedImage image;
  image.format = ImageFormat::kPng;
  constexpr std::size_t kHeaderEnd =
      26;  // signature, IHDR's length and name, width, height, bits, colours
  if (bytes.size() < kHeaderEnd ||
      std::search(bytes.end() - 12, bytes.end(), kPngEnd.begin(), kPngEnd.end()) == bytes.end()) {
    fail(where, "is a torn PNG (its end is missing)");
  }
  image.width = big_endian_32(bytes, 16);
  image.height = big_endian_32(bytes, 20);
  image.bits = std::max<int>(bytes[24], 8);
  const bool is_grey = (bytes[25] & 2) == 0;
  image.channels = is_grey ? 1 : 3;
  if (image.width <= 0 || image.height <= 0) fail(where, "is a PNG without size");
  image.bytes = std::move(bytes);
  return image;
}

EncodedImage describe(const cv::Mat& pixels, ImageFormat format) {
  EncodedImage image;
  image.format = format;
  image.width = pixels.cols;
  image.height = pixels.rows;
  image.channels = pixels.channels();
  image.bits = pixels.depth() == CV_16U ? 16 : 8;
  return image;
}

}  // namespace

EncodedImage read_encoded_image(const std::string& path) {
  check_is_file(path, "give a picture");
  std::ifstream file(path, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw InputError(path + ": cannot be read; check that it exists and may be read");
  return identify_image(std::move(bytes), path);
}

EncodedImage identify_image(std::vector<std::uint8_t> bytes, const std::string& where) {
  if (bytes.size() > 2 && bytes[0] == 0xFF && bytes[1] == 0xD8) {
    return identify_jpeg(std::move(bytes), where);
  }
  if (bytes.size() >= kPngSignature.size() &&
      std::equal(kPngSignature.begin(), kPngSignature.end(), bytes.begin())) {
    return identify_png(std::move(bytes), where);
  }
  fail(where, bytes.empty() ? "is empty" : "is neither JPEG nor PNG");
}

void check_8_bit(const EncodedImage& image, const std::string& where) {
  constexpr int kBits = 8;
  if (image.bits == kBits) return;
  throw InputError(where + ": is " + std::to_string(image.bits) +
                   " bit; 8 bit expected, record or convert it so");
}

EncodedImage encode_jpeg(const cv::Mat& image, int quality) {
  EncodedImage coded = describe(image, ImageFormat::kJpeg);
  coded.bytes = compress_jpeg(image, quality);
  return coded;
}

EncodedImage encode_png(const cv::Mat& image) {
  // On depth images half the time of the default for 5 % more bytes.
  constexpr int kFastCompression = 1;
  EncodedImage coded = describe(image, ImageFormat::kPng);
  if (!cv::imencode(".png", image, coded.bytes, {cv::IMWRITE_PNG_COMPRESSION, kFastCompression}))
    throw std::runtime_error("image cannot be coded as PNG");
  return coded;
}

cv::Mat decode_image(const EncodedImage& image, const std::string& where) {
  const int color = image.channels == 1 ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR;
  const cv::Mat pixels =
      image.format == ImageFormat::kJpeg
          ? decompress_jpeg(image.bytes, {image.width, image.height})
          : cv::imdecode(image.bytes, color | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
  if (pixels.empty()) fail(where, "cannot be decoded");
  return pixels;
}

cv::Mat decode_grey(const EncodedImage& image, const std::string& where) {
  const cv::Mat pixels = decode_image(image, where);
  if (pixels.channels() == 1) return pixels;
  cv::Mat grey;
  cv::cvtColor(pixels, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace limbcast
