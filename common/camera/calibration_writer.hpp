#pragma once

#include <string>

#include "common/camera/calibration.hpp"

namespace limbcast {

/// Writes a calibration as read_stereo_calibration reads it (OpenCV FileStorage YAML), with R1 R2
/// P1 P2 Q where it has a rectification, and the mounting as far as it is known. Throws
/// std::runtime_error where the file cannot be written.
void write_stereo_calibration(const std::string& path, const StereoCalibration& calibration);

/// Writes a depth camera's calibration as read_depth_calibration reads it. Throws
/// std::runtime_error where the file cannot be written.
void write_depth_calibration(const std::string& path, const DepthCalibration& calibration);

}  // namespace limbcast
