#pragma once

#include <opencv2/core/mat.hpp>

#include "common/cloud/cloud.hpp"

namespace limbcast {

/// One pair as the camera took it (not yet rectified unless the calibration says so). 8-bit BGR or
/// grey.
struct StereoImages {
  Stamp stamp;
  cv::Mat left, right;
};

/// One frame of a depth camera: 8-bit BGR (may be empty) and registered 16-bit depth, 0 = hole.
struct DepthImages {
  Stamp stamp;
  cv::Mat color, depth;
};

}  // namespace limbcast
