#pragma once

#include <Eigen/Core>

namespace limbcast {

/// An ideal (rectified, undistorted) camera: pixel = (fx * x / z + cx, fy * y / z + cy), pixel
/// centres at whole numbers. Frame: x right, y down, z forward, metres.
struct PinholeCamera {
  int width = 0;              ///< [px]
  int height = 0;             ///< [px]
  double fx = 0.0, fy = 0.0;  ///< focal lengths [px]
  double cx = 0.0, cy = 0.0;  ///< principal point [px]

  /// Point at pixel (u, v) whose distance along the optical axis is `z_m`.
  Eigen::Vector3f back_project(float u, float v, float z_m) const {
    return {(u - static_cast<float>(cx)) / static_cast<float>(fx) * z_m,
            (v - static_cast<float>(cy)) / static_cast<float>(fy) * z_m, z_m};
  }
  /// Pixel coordinates of `point_m`, whose z must be positive.
  Eigen::Vector2f project(const Eigen::Vector3f& point_m) const {
    return {static_cast<float>(fx) * point_m.x() / point_m.z() + static_cast<float>(cx),
            static_cast<float>(fy) * point_m.y() / point_m.z() + static_cast<float>(cy)};
  }
};

}  // namespace limbcast
