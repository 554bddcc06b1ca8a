#pragma once

#include <string>
#include <vector>

#include "common/camera/calibration.hpp"

namespace limbcast {

/// Reads a stereo calibration and checks that it can be one. `path` is
/// - an OpenCV FileStorage file with cv::stereoCalibrate's names: image_width, image_height, K1 D1
/// K2 D2 R T
///   (metres), together or not at all R1 R2 P1 P2, and, of fisheye lenses, "distortion_model:
///   equidistant";
/// - a ROS camera_info pair: a folder with left.yaml and right.yaml, or the left one's path (the
/// right one's
///   name has "right" where it has "left"). The baseline comes from the right projection_matrix.
/// Optional in the (left) file: down (3 numbers, gravity in the rectified left camera),
/// sensor_height_m. Throws InputError: file, key, what was found, what to do.
StereoCalibration read_stereo_calibration(const std::string& path);
/// The files that a calibration at `path`, no folder, is read from: itself, and a ROS pair's right
/// one.
std::vector<std::string> calibration_files(const std::string& path);

/// Reads a depth camera's calibration: image_width, image_height, camera_matrix,
/// distortion_coefficients (OpenCV or ROS YAML), depth_scale (metres a unit, default 0.001), and
/// optionally down, sensor_height_m. Where depth is not registered to colour: depth_image_width,
/// depth_image_height, depth_camera_matrix, depth_distortion_coefficients, R, T. Of fisheye lenses
/// distortion_model and depth_distortion_model tell it.
DepthCalibration read_depth_calibration(const std::string& path);

/// Distance between the optical centres along the left camera's x axis [m].
double baseline_m(const StereoCalibration& calibration);

}  // namespace limbcast
