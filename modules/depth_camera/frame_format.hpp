#pragma once

#include "common/camera/calibration.hpp"
#include "common/sources/pair_source.hpp"

namespace limbcast::depth_camera {

/// How the images of a depth camera are named and must look: colour may be absent, and depth that
/// is not registered to it has a size of its own.
PairFormat frame_format(const DepthCalibration& calibration);

}  // namespace limbcast::depth_camera
