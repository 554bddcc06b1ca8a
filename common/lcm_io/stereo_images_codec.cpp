#include "common/lcm_io/stereo_images_codec.hpp"

#include "common/lcm_io/image_codec.hpp"
#include "common/lcm_io/message_error.hpp"
#include "common/lcm_io/stamp_codec.hpp"

namespace limbcast::lcm_io {
namespace {

image_t coded(const cv::Mat& image, ImageCoding coding, int jpeg_quality) {
  switch (coding) {
    case ImageCoding::kJpeg:
      return to_jpeg_message(image, jpeg_quality);
    case ImageCoding::kPng:
      return to_png_message(image);
    default:
      return to_raw_message(image);
  }
}

}  // namespace

stereo_images_t to_message(const StereoImages& images, ImageCoding coding, int jpeg_quality) {
  stereo_images_t message{};
  message.stamp = to_message(images.stamp);
  message.left = coded(images.left, coding, jpeg_quality);
  message.right = coded(images.right, coding, jpeg_quality);
  return message;
}

StereoImages from_message(const stereo_images_t& message) {
  StereoImages images;
  images.stamp = from_message(message.stamp);
  images.left = from_message(message.left);
  images.right = from_message(message.right);
  require(!images.left.empty() && !images.right.empty(), "stereo images: an image is missing");
  require(images.left.size() == images.right.size(),
          "stereo images: left and right differ in size");
  require(images.left.depth() == CV_8U && images.right.depth() == CV_8U,
          "stereo images: not 8 bit");
  return images;
}

}  // namespace limbcast::lcm_io
