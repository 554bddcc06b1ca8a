#pragma once

#include <Eigen/Core>
#include <opencv2/core/eigen.hpp>
#include <opencv2/core/matx.hpp>

#include "common/camera/pinhole_camera.hpp"

namespace limbcast {

/// K, as OpenCV's functions take a camera's intrinsics.
inline cv::Matx33d camera_matrix(const PinholeCamera& camera) {
  return {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
}

template <int kRows, int kColumns>
cv::Matx<double, kRows, kColumns> to_cv(const Eigen::Matrix<double, kRows, kColumns>& matrix) {
  cv::Matx<double, kRows, kColumns> result;
  cv::eigen2cv(matrix, result);
  return result;
}

}  // namespace limbcast
