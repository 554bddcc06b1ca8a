#include "common/lcm_io/image_codec.hpp"

#include "common/camera/calibration.hpp"

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "common/camera/encoded_image.hpp"
#include "common/camera/jpeg.hpp"
#include "common/lcm_io/message_error.hpp"

namespace limbcast::lcm_io {
namespace {

image_t message_of(const cv::Mat& image, std::int8_t encoding, std::vector<std::uint8_t> data) {
  image_t message{};
  message.width = image.cols;
  message.height = image.rows;
  message.encoding = encoding;
  message.size = static_cast<std::int32_t>(data.size());
  message.data = std::move(data);
  return message;
}

cv::Mat decode_raw(const image_t& message, int channels) {
  const std::size_t expected = static_cast<std::size_t>(message.width) * message.height * channels;
  require(message.data.size() == expected, "image: raw data has another size than width x height");
  cv::Mat image(message.height, message.width, CV_8UC(channels));
  std::copy(message.data.begin(), message.data.end(), image.data);
  return image;
}

cv::Mat decompress_png(const std::vector<std::uint8_t>& data) {
  try {
    return cv::imdecode(data,
                        cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    return {};
  }
}

/// A camera's note that it was held upright does not turn the pixels away from its calibration.
cv::Mat decode_file(const image_t& message) {
  const cv::Size size(message.width, message.height);
  const cv::Mat image = message.encoding == image_t::JPEG ? decompress_jpeg(message.data, size)
                                                          : decompress_png(message.data);
  require(!image.empty(), "image: data cannot be decoded");
  require(image.size() == size, "image: decoded size differs from width x height");
  return image;
}

}  // namespace

image_t to_jpeg_message(const cv::Mat& image, int quality) {
  if (image.empty()) return {};
  return message_of(image, image_t::JPEG, compress_jpeg(image, quality));
}

image_t to_png_message(const cv::Mat& image) {
  if (image.empty()) return {};
  return message_of(image, image_t::PNG, encode_png(image).bytes);
}

image_t to_raw_message(const cv::Mat& image) {
  if (image.empty()) return {};
  const cv::Mat packed = image.isContinuous() ? image : image.clone();
  const std::int8_t encoding = image.channels() == 1 ? image_t::RAW_GRAY8 : image_t::RAW_BGR8;
  return message_of(image, encoding,
                    {packed.data, packed.data + packed.total() * packed.elemSize()});
}

image_t to_message(const EncodedImage& image) {
  image_t message{};
  message.width = image.width;
  message.height = image.height;
  message.encoding = image.format == ImageFormat::kJpeg ? image_t::JPEG : image_t::PNG;
  message.size = static_cast<std::int32_t>(image.bytes.size());
  message.data = image.bytes;
  return message;
}

cv::Mat from_message(const image_t& message) {
  if (message.width == 0 && message.height == 0) return {};
  require(message.width > 0 && message.height > 0 && message.width <= kMaxImageSide &&
              message.height <= kMaxImageSide,
          "image: size is out of range");
  require(!message.data.empty(), "image: no data");
  switch (message.encoding) {
    case image_t::RAW_GRAY8:
      return decode_raw(message, 1);
    case image_t::RAW_BGR8:
      return decode_raw(message, 3);
    case image_t::JPEG:
    case image_t::PNG:
      return decode_file(message);
    default:
      throw MessageError("image: unknown encoding");
  }
}

}  // namespace limbcast::lcm_io
