#pragma once

#include <Eigen/Core>

namespace limbcast::segmenter {

/// Centre of the head whose surface is seen at `seed_m`, in the sensor's frame, and back.
Eigen::Vector3f behind_surface(const Eigen::Vector3f& seed_m);
Eigen::Vector3f surface_before(const Eigen::Vector3f& center_m);

}  // namespace limbcast::segmenter
