#pragma once

#include <string>

#include "modules/simulate/skeleton.hpp"

namespace limbcast::simulate {

/// Unit vector in the frame of ArmPose, `azimuth` outward from straight ahead, `elevation` over the
/// horizon.
Eigen::Vector3d heading(double azimuth_deg, double elevation_deg);

/// A nearly straight arm whose axis, shoulder to wrist, is `direction`.
ArmPose stretched_arm(Rng& rng, const BodyShape& body, const Eigen::Vector3d& direction,
                      double bend_deg, HandShape hand);

/// An arm that does what `name` says ("hang", "phone", "wave", "raise", "any" ...), with some
/// freedom. Throws std::out_of_range for an unknown name.
ArmPose draw_arm(Rng& rng, const BodyShape& body, const std::string& name);

}  // namespace limbcast::simulate
