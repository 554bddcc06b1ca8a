#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/human_model/body_pose.hpp"

namespace limbcast::pose_fitter {

/// When an arm points: it is nearly straight and raised. People whose arms are both bent (elbow by
/// more than 60 degrees) or hanging (within 35 degrees of the trunk) do not.
struct PointingParams {
  /// An elbow that bends more is no pointing arm [deg]. Half way between the straight arm and the
  /// 60 degrees that the truth calls bent, and 15 of measuring error.
  double max_elbow_bend_deg = 45.0;
  /// Least angle between the line shoulder-wrist and the trunk, neck to pelvis [deg]: the truth
  /// calls an arm within 35 degrees hanging.
  double min_raise_deg = 35.0;
};

/// The arms that point, the straighter and more raised one first. Arms of which shoulder, elbow or
/// wrist was left out do not. `down` stands in for the trunk where neck or pelvis is missing.
std::vector<Pointing> find_pointing(const BodyPose& body, const Eigen::Vector3f& down,
                                    const PointingParams& params = {});

}  // namespace limbcast::pose_fitter
