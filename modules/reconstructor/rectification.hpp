#pragma once

#include "common/camera/calibration.hpp"

namespace limbcast::reconstructor {

/// What turns a calibrated pair into one whose rows match: cv::stereoRectify (Bouguet), without
/// black borders. Of fisheye lenses the rectified cameras see no more than 110 degrees, left to
/// right and top to bottom.
Rectification compute_rectification(const StereoCalibration& calibration);

}  // namespace limbcast::reconstructor
