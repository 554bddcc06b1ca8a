#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/cloud/cloud.hpp"
#include "modules/segmenter/params.hpp"

namespace limbcast::segmenter {

/// A plane under the sensor: height of p over it = height_m - down . p.
struct Ground {
  Eigen::Vector3f down{0.0F, 1.0F, 0.0F};  ///< unit normal, towards the ground
  float height_m = 0.0F;                   ///< of the sensor over the plane
};

/// The ground that `cloud` shows, near to what gravity tells; nothing where too little of it is in
/// sight. A sensor height in the stamp narrows the search to 15 cm around it.
std::optional<Ground> find_ground(const Cloud& cloud, const GroundParams& params);

}  // namespace limbcast::segmenter
