#pragma once

#include <Eigen/Core>
#include <array>

#include "common/human_model/joint_angles.hpp"

namespace limbcast {

using Angles = std::array<float, kDegreesOfFreedom>;

/// Places of the angles in joint_limits.json.
int dof_index(const HumanModel& model, const std::string& name);

/// Link ends of a body with these angles [rad], written from their definition in joint_angles.hpp;
/// the sum of twists and the pelvis' pitch are taken as they are. `body`: its axes in columns.
Skeleton skeleton_from_angles(const Angles& angles, const HumanModel& model,
                              const Eigen::Matrix3f& body, const Eigen::Vector3f& head_m);

/// What the pelvis' pitch is, by definition, for the hips' flexions of these angles.
float pelvis_pitch_of(const Angles& angles, const HumanModel& model);

}  // namespace limbcast
