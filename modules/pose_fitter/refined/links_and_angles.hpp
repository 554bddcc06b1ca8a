#pragma once

#include <Eigen/Core>

#include "common/human_model/body_pose.hpp"
#include "common/human_model/human_model.hpp"

namespace limbcast::pose_fitter::refined {

/// Fills a pose's link lengths and joint angles from its joints, as far as those that they need are
/// valid. `front`: where the whole body faces, `down`: gravity, both in the pose's frame. Of a body
/// that faces up or down no angles are told.
void add_links_and_angles(const HumanModel& model, const Eigen::Vector3f& front,
                          const Eigen::Vector3f& down, BodyPose& pose);

}  // namespace limbcast::pose_fitter::refined
