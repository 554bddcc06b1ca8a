#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/camera/calibration.hpp"

namespace limbcast::depth_camera {

/// Turns the depth image of a camera beside the colour camera into one that the colour camera
/// would see: pixel for pixel with the colour image, depths along its axis.
class DepthRegistration {
 public:
  /// `calibration` must tell of a depth camera of its own.
  explicit DepthRegistration(const DepthCalibration& calibration);

  /// `depth`: 16 bit, of the depth camera's size, 0 = none. Where several of its pixels meet in one
  /// of the result, the nearest wins; what only the colour camera sees stays 0.
  cv::Mat1w registered(const cv::Mat& depth) const;

 private:
  LensCalibration color_;
  DepthCamera depth_camera_;
  double depth_scale_m_;
  std::vector<cv::Point2d> rays_;  ///< (x / z, y / z) of each pixel of the depth image
};

}  // namespace limbcast::depth_camera
