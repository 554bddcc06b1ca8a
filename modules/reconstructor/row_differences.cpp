#include "modules/reconstructor/row_differences.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "common/median.hpp"

namespace limbcast::reconstructor {
namespace {

/// Where points of one image stand in the other.
struct Tracks {
  std::vector<cv::Point2f> to;
  std::vector<uchar> found;
};
Tracks track(const cv::Mat& from_image, const cv::Mat& to_image,
             const std::vector<cv::Point2f>& from) {
  constexpr int kWindow_px = 21, kPyramidLevels = 5;
  Tracks tracks;
  cv::calcOpticalFlowPyrLK(from_image, to_image, from, tracks.to, tracks.found, cv::noArray(),
                           {kWindow_px, kWindow_px}, kPyramidLevels);
  return tracks;
}

}  // namespace

std::vector<double> row_differences_px(const RectifiedPair& pair,
                                       const RowDifferenceParams& params) {
  std::vector<cv::Point2f> left;
  cv::goodFeaturesToTrack(pair.left, left, params.max_corners, params.min_quality,
                          params.min_spacing_px);
  if (left.empty()) return {};
  const Tracks there = track(pair.left, pair.right, left);
  const Tracks back = track(pair.right, pair.left, there.to);
  // Nothing stands behind infinity, but for the error of a match.
  constexpr float kBehindInfinity_px = 1.0F;
  std::vector<double> differences_px;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (there.found[i] == 0 || back.found[i] == 0) continue;
    if (cv::norm(back.to[i] - left[i]) > params.max_return_px) continue;
    const cv::Point2f step = there.to[i] - left[i];
    if (step.x <= kBehindInfinity_px && std::abs(step.y) <= params.max_difference_px)
      differences_px.push_back(step.y);
  }
  return differences_px;
}

double median_size_px(std::vector<double> differences_px) {
  for (double& difference_px : differences_px) difference_px = std::abs(difference_px);
  return median(std::move(differences_px));
}

}  // namespace limbcast::reconstructor
