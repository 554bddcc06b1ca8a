#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "common/camera/calibration.hpp"

namespace limbcast::test {

/// Folder of rendered stereo recordings with truth; may be absent.
std::string stereo_dev_folder();

/// Calibration of a recording.
StereoCalibration read_calibration(const std::string& folder);

/// Names of the frames of a recording without their endings, in order.
std::vector<std::string> frame_names(const std::string& folder);

/// One frame of a rendered recording. The truth is in the rectified left camera.
struct TrueFrame {
  cv::Mat left, right;        ///< BGR
  cv::Mat1f disparity_px;     ///< true disparity, 0 = none
  cv::Mat1b person;           ///< index of the person, 0 = none
  bool is_tuning = true;      ///< only bodies D1-D3; frames with D4 or D5 are for checking
  Eigen::Vector3f down;       ///< true gravity
  float sensor_height_m = 0;  ///< true height over the ground
};
TrueFrame read_true_frame(const std::string& folder, const std::string& name,
                          double focal_baseline);

}  // namespace limbcast::test
