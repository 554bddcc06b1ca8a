#include "modules/stereo_camera/swap_check.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace limbcast::stereo_camera {
namespace {

/// Disparity of a point at infinity in front of the left camera [px].
double infinity_px(const StereoCalibration& calibration) {
  const Eigen::Vector3d ahead = calibration.R * Eigen::Vector3d::UnitZ();
  const PinholeCamera& right = calibration.right.camera;
  return calibration.left.camera.cx - (right.fx * ahead.x() / ahead.z() + right.cx);
}

/// Place of the only good match of `block` on the strip [px], where there is one.
std::optional<int> find(const cv::Mat& block, const cv::Mat& strip, const SwapCheckParams& params) {
  cv::Mat correlation;
  cv::matchTemplate(strip, block, correlation, cv::TM_CCOEFF_NORMED);
  cv::reduce(correlation, correlation, 0, cv::REDUCE_MAX);
  double best = 0.0;
  cv::Point place;
  cv::minMaxLoc(correlation, nullptr, &best, nullptr, &place);
  if (best < params.min_correlation) return std::nullopt;
  // The neighbours of the best place are the same match.
  constexpr int kPeakHalfWidth_px = 2;
  correlation
      .colRange(std::max(0, place.x - kPeakHalfWidth_px),
                std::min(correlation.cols, place.x + kPeakHalfWidth_px + 1))
      .setTo(-1.0);
  double second = 0.0;
  cv::minMaxLoc(correlation, nullptr, &second);
  if (best - second < params.min_lead) return std::nullopt;
  return place.x;
}

}  // namespace

SwapEvidence compare_blocks(const cv::Mat& left_grey, const cv::Mat& right_grey,
                            const StereoCalibration& calibration, const SwapCheckParams& params) {
  const double scale = static_cast<double>(params.width_px) / left_grey.cols;
  cv::Mat left;
  cv::Mat right;
  cv::resize(left_grey, left, {}, scale, scale, cv::INTER_AREA);
  cv::resize(right_grey, right, {}, scale, scale, cv::INTER_AREA);
  const int half = params.half_block_px;
  const int reach = static_cast<int>(params.reach * left.cols);
  const double infinity = scale * infinity_px(calibration);
  const int lines = params.line_tolerance_px;

  SwapEvidence evidence;
  for (int v = half + lines; v + half + lines < left.rows; v += params.step_px) {
    for (int u = half + reach; u + half + reach < left.cols; u += params.step_px) {
      const cv::Mat block = left({u - half, v - half, 2 * half + 1, 2 * half + 1});
      cv::Scalar mean;
      cv::Scalar deviation;
      cv::meanStdDev(block, mean, deviation);
      if (deviation[0] < params.min_deviation) continue;
      const cv::Mat strip = right(
          {u - half - reach, v - half - lines, 2 * (half + reach) + 1, 2 * (half + lines) + 1});
      const std::optional<int> place = find(block, strip, params);
      if (!place) continue;
      const double disparity = reach - *place;
      ++evidence.blocks;
      evidence.behind_infinity += disparity < infinity - params.margin_px ? 1 : 0;
    }
  }
  return evidence;
}

bool looks_swapped(const SwapEvidence& evidence, const SwapCheckParams& params) {
  return evidence.blocks >= params.min_blocks &&
         evidence.behind_infinity >= params.min_share * evidence.blocks;
}

}  // namespace limbcast::stereo_camera
