#include "modules/segmenter/scene/nearest_pixels.hpp"

#include <opencv2/imgproc.hpp>
#include <vector>

namespace limbcast::segmenter {

void fill_from_nearest(const cv::Mat1b& empty, int radius_px,
                       const std::function<void(std::size_t pixel, std::size_t nearest)>& fill) {
  // Scanners see a part of the sphere only: beyond it nothing has a neighbour.
  cv::Rect seen = cv::boundingRect(empty == 0);
  if (seen.empty()) return;
  const cv::Point reach(radius_px, radius_px);
  seen = cv::Rect(seen.tl() - reach, seen.br() + reach) & cv::Rect({0, 0}, empty.size());
  const cv::Mat1b part = empty(seen);
  cv::Mat1f distance_px;
  cv::Mat1i label;
  cv::distanceTransform(part, distance_px, label, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  const auto pixel_at = [&](int u, int v) {
    return static_cast<std::size_t>(seen.y + v) * static_cast<std::size_t>(empty.cols) +
           static_cast<std::size_t>(seen.x + u);
  };
  std::vector<std::size_t> pixel_of_label(part.total() + 1, 0);
  for (int v = 0; v < part.rows; ++v) {
    for (int u = 0; u < part.cols; ++u) {
      if (part(v, u) == 0) pixel_of_label[static_cast<std::size_t>(label(v, u))] = pixel_at(u, v);
    }
  }
  for (int v = 0; v < part.rows; ++v) {
    for (int u = 0; u < part.cols; ++u) {
      if (part(v, u) != 0 && distance_px(v, u) <= static_cast<float>(radius_px))
        fill(pixel_at(u, v), pixel_of_label[static_cast<std::size_t>(label(v, u))]);
    }
  }
}

}  // namespace limbcast::segmenter
