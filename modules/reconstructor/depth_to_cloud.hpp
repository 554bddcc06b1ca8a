#pragma once

#include <opencv2/core/mat.hpp>

#include "common/camera/calibration.hpp"
#include "common/cloud/cloud.hpp"

namespace limbcast::reconstructor {

struct DepthToCloudParams {
  /// Points outside are dropped [m].
  double near_limit_m = 0.3;
  double far_limit_m = 12.0;
  /// Standard deviation of a depth: constant_m + quadratic_per_m * z^2. RealSense D435, see
  /// README.md.
  double noise_constant_m = 0.002;
  double noise_quadratic_per_m = 0.0020;
  /// A pixel is flying, between two surfaces, where the depth changes by more than this share of
  /// the depth towards both sides of it, once nearer and once farther; 0 keeps all.
  double flying_step_share = 0.02;
};

/// Organised cloud in the colour camera's frame. `depth` is 16-bit and registered to `color` (8-bit
/// BGR or grey, or empty), 0 = hole. Fills points, colours, camera and depth noise. Throws
/// std::invalid_argument where sizes or types do not fit.
Cloud depth_to_cloud(const cv::Mat& depth, const cv::Mat& color,
                     const DepthCalibration& calibration, const DepthToCloudParams& params = {});

}  // namespace limbcast::reconstructor
