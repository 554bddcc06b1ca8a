#pragma once

#include <opencv2/core/mat.hpp>

#include "common/cloud/cloud.hpp"
#include "modules/reconstructor/disparity.hpp"

namespace limbcast::reconstructor {

struct TriangulationParams {
  /// Points outside are dropped [m].
  double near_limit_m = 1.0;
  double far_limit_m = 12.0;
  /// Standard deviation of the disparity [px], which gives the cloud's depth noise.
  /// On people in data with truth the median error is 0.06 to 0.08 px (README.md).
  double sigma_disparity_px = 0.10;
};

/// Organised cloud in the frame of the rectified left camera, z = f * B / disparity; a pixel
/// without a match is a hole. `color` (8-bit BGR or grey, or empty) is the rectified left image.
/// Fills points, colours, camera and depth noise; the stamp's other fields are the caller's.
Cloud triangulate(const DisparityImage& disparity, const cv::Mat& color,
                  const PinholeCamera& camera, double baseline_m,
                  const TriangulationParams& params = {});

}  // namespace limbcast::reconstructor
