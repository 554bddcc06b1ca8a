#include "modules/reconstructor/corner_tracks.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace limbcast::reconstructor {
namespace {

/// Where points of one image stand in the other.
struct Tracks {
  std::vector<cv::Point2f> to;
  std::vector<uchar> found;
};

Tracks track(const cv::Mat& from_image, const cv::Mat& to_image,
             const std::vector<cv::Point2f>& from, const CornerParams& params) {
  Tracks tracks;
  cv::calcOpticalFlowPyrLK(from_image, to_image, from, tracks.to, tracks.found, cv::noArray(),
                           {params.window_px, params.window_px}, params.pyramid_levels);
  return tracks;
}

/// A place of a small image in one that is `scale` times as wide; pixels' middles are whole.
cv::Point2f enlarged(const cv::Point2f& place, float scale) {
  return {(place.x + 0.5F) * scale - 0.5F, (place.y + 0.5F) * scale - 0.5F};
}

}  // namespace

std::vector<CornerTrack> track_corners(const RectifiedPair& pair, const CornerParams& params) {
  std::vector<cv::Point2f> left;
  cv::goodFeaturesToTrack(pair.left, left, params.max_corners, params.min_quality,
                          params.min_spacing_px);
  if (left.empty()) return {};
  const Tracks there = track(pair.left, pair.right, left, params);
  Tracks back = {left, there.found};
  if (params.max_return_px) back = track(pair.right, pair.left, there.to, params);
  // Nothing stands behind infinity, but for the error of a match.
  constexpr float kBehindInfinity_px = 1.0F;
  std::vector<CornerTrack> tracks;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (there.found[i] == 0 || back.found[i] == 0) continue;
    if (cv::norm(back.to[i] - left[i]) > params.max_return_px.value_or(0.0)) continue;
    const cv::Point2f step = there.to[i] - left[i];
    if (step.x <= kBehindInfinity_px && std::abs(step.y) <= params.max_difference_px)
      tracks.push_back({left[i], there.to[i]});
  }
  return tracks;
}

std::vector<CornerTrack> track_again(const std::vector<CornerTrack>& corners,
                                     const RectifiedPair& larger, float scale, int window_px,
                                     double max_move_px) {
  if (corners.empty()) return {};
  std::vector<cv::Point2f> left, before;
  for (const CornerTrack& corner : corners) {
    left.push_back(enlarged(corner.left, scale));
    before.push_back(enlarged(corner.right, scale));
  }
  std::vector<cv::Point2f> right = before;
  std::vector<uchar> found;
  cv::calcOpticalFlowPyrLK(
      larger.left, larger.right, left, right, found, cv::noArray(), {window_px, window_px}, 0,
      cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 0.01),
      cv::OPTFLOW_USE_INITIAL_FLOW);
  std::vector<CornerTrack> tracks;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (found[i] != 0 && cv::norm(right[i] - before[i]) <= max_move_px)
      tracks.push_back({left[i], right[i]});
  return tracks;
}

}  // namespace limbcast::reconstructor
