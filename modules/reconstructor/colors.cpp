#include "modules/reconstructor/colors.hpp"

#include <cstring>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace limbcast::reconstructor {
namespace {

void check_type(const cv::Mat& image) {
  if (image.type() != CV_8UC1 && image.type() != CV_8UC3)
    throw std::invalid_argument("image must be 8-bit BGR or grey");
}

}  // namespace

std::vector<Bgr> colors_of(const cv::Mat& image) {
  static_assert(sizeof(Bgr) == 3);
  if (image.empty()) return {};
  check_type(image);
  cv::Mat bgr = image;
  if (image.channels() == 1) cv::cvtColor(image, bgr, cv::COLOR_GRAY2BGR);
  std::vector<Bgr> colors(bgr.total());
  for (int v = 0; v < bgr.rows; ++v)
    std::memcpy(&colors[static_cast<std::size_t>(v) * bgr.cols], bgr.ptr(v), 3UL * bgr.cols);
  return colors;
}

cv::Mat1b grey_of(const cv::Mat& image) {
  check_type(image);
  if (image.channels() == 1) return image;
  cv::Mat1b grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

cv::Mat1b shrunk(const cv::Mat& image, int by) {
  const cv::Mat1b grey = grey_of(image);
  if (by <= 1) return grey;
  cv::Mat1b small;
  cv::resize(grey, small, {}, 1.0 / by, 1.0 / by, cv::INTER_AREA);
  return small;
}

}  // namespace limbcast::reconstructor
