#include "common/sources/picture.hpp"

#include <opencv2/imgproc.hpp>

#include "common/sources/pair_source.hpp"

namespace limbcast {
namespace {

cv::Mat converted(const cv::Mat& pixels, PixelLayout layout) {
  cv::Mat bgr;
  switch (layout) {
    case PixelLayout::kPlain:
      return pixels;
    case PixelLayout::kRgb:
      cv::cvtColor(pixels, bgr, cv::COLOR_RGB2BGR);
      break;
    case PixelLayout::kYuyv:
      cv::cvtColor(pixels, bgr, cv::COLOR_YUV2BGR_YUYV);
      break;
    case PixelLayout::kUyvy:
      cv::cvtColor(pixels, bgr, cv::COLOR_YUV2BGR_UYVY);
      break;
    case PixelLayout::kNv12:
      cv::cvtColor(pixels, bgr, cv::COLOR_YUV2BGR_NV12);
      break;
    case PixelLayout::kYuv420:
      cv::cvtColor(pixels, bgr, cv::COLOR_YUV2BGR_I420);
      break;
  }
  return bgr;
}

}  // namespace

cv::Mat plain_pixels(const Picture& picture, const std::string& where) {
  return picture.jpeg ? decode_image(*picture.jpeg, where)
                      : converted(picture.pixels, picture.layout);
}

EncodedImage coded_for_sending(const Picture& picture, int jpeg_quality) {
  if (picture.jpeg) return *picture.jpeg;
  return coded_for_sending(converted(picture.pixels, picture.layout), jpeg_quality);
}

}  // namespace limbcast
