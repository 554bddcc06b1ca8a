#pragma once

#include <gtest/gtest.h>

#include <opencv2/core/types.hpp>

#include "common/camera/calibration.hpp"

namespace limbcast::calibrate {

inline const cv::Size kVga(640, 480);

/// Focal length to 0.3 %, baseline to 0.5 %: what depth of a few per cent at 4 m needs.
inline void expect_found(const StereoCalibration& found, const StereoCalibration& truth) {
  EXPECT_NEAR(found.left.camera.fx, truth.left.camera.fx, 0.003 * truth.left.camera.fx);
  EXPECT_NEAR(found.left.camera.fy, truth.left.camera.fy, 0.003 * truth.left.camera.fy);
  EXPECT_NEAR(found.right.camera.fx, truth.right.camera.fx, 0.003 * truth.right.camera.fx);
  EXPECT_NEAR(found.T.norm(), truth.T.norm(), 0.005 * truth.T.norm());
  EXPECT_EQ(found.left.model, truth.left.model);
  EXPECT_EQ(found.right.model, truth.right.model);
  constexpr double kTenthOfDegree = 1.745e-3;
  EXPECT_NEAR((found.R - truth.R).cwiseAbs().maxCoeff(), 0.0, 2.0 * kTenthOfDegree);
}

}  // namespace limbcast::calibrate
