#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/camera/pinhole_camera.hpp"

namespace limbcast {

/// PinholeCamera::back_project() for all pixels of an image, with the same result: its divisions
/// are done once for each column and row, not for each pixel.
class PixelRays {
 public:
  explicit PixelRays(const PinholeCamera& camera);
  /// Points of the pixels of row v, whose distances along the optical axis are z_m.
  void back_project_row(int v, const float* z_m, Eigen::Vector3f* points_m) const;

 private:
  PinholeCamera camera_;
  std::vector<float> x_;  ///< of each column's points at z = 1
};

}  // namespace limbcast
