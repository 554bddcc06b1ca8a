#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/camera/pinhole_camera.hpp"

namespace limbcast {

/// Larger than any camera that fits a robot; guards against nonsense in files and messages [px].
inline constexpr int kMaxImageSide = 8192;

/// A rectified camera may show more or less than the lens does, by no more than so many times.
inline constexpr double kLargestRectifiedZoom = 10.0;

/// How the angle between a ray and the optical axis becomes a distance from the principal point.
enum class LensModel {
  /// By the angle's tangent, and OpenCV's distortion (ROS: plumb_bob, rational_polynomial).
  kPinhole,
  /// By the angle itself, and a polynomial of it: Kannala and Brandt, A Generic Camera Model, PAMI
  /// 2006 (OpenCV: cv::fisheye; ROS: equidistant).
  kFisheye
};
/// A fisheye's model in calibration files, as ROS names it.
inline constexpr const char* kFisheyeName = "equidistant";
/// k1 k2 k3 k4, as cv::fisheye takes them.
inline constexpr int kFisheyeCoefficients = 4;

/// One real lens: focal lengths and principal point, and distortion coefficients: of a pinhole k1
/// k2 p1 p2 k3 ..., 0, 4, 5, 8, 12 or 14 of them (none = no distortion); of a fisheye k1 k2 k3 k4.
struct LensCalibration {
  PinholeCamera camera;
  std::vector<double> distortion;
  LensModel model = LensModel::kPinhole;
};

/// How the sensor stands on the robot; what is not known is not set.
struct Mounting {
  std::optional<Eigen::Vector3d>
      down;  ///< unit gravity vector in the (rectified left) camera's frame
  std::optional<double> sensor_height_m;  ///< of the camera over the ground
};

/// Rotations and projections of a rectified pair, names as cv::stereoRectify gives them.
struct Rectification {
  Eigen::Matrix3d R1 = Eigen::Matrix3d::Identity(), R2 = Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 3, 4> P1 = Eigen::Matrix<double, 3, 4>::Zero(), P2 = P1;
};

/// A stereo camera as cv::stereoCalibrate describes it: p_right = R * p_left + T [m].
struct StereoCalibration {
  LensCalibration left, right;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d T = Eigen::Vector3d::Zero();
  std::optional<Rectification> rectification;  ///< where the file carries one; else it is computed
  Mounting mounting;
};

/// A depth camera that stands beside the colour camera: p_color = R * p_depth + T [m].
struct DepthCamera {
  LensCalibration lens;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d T = Eigen::Vector3d::Zero();
};

/// A camera that gives colour and depth.
struct DepthCalibration {
  LensCalibration color;
  /// None: the depth image is registered to the colour image already.
  std::optional<DepthCamera> depth_camera;
  double depth_scale_m = 0.001;  ///< metres for one unit of the 16-bit depth image
  Mounting mounting;
};

}  // namespace limbcast
