#pragma once

#include "common/human_model/joint_angles.hpp"
#include "modules/pose_fitter/paper/rotation_fitter.hpp"

namespace limbcast::pose_fitter {

/// Link ends of a fitted pose as joints, on the sheet on which they were fitted.
Skeleton skeleton_of(const FittedPose& pose, const HumanModel& model);

/// Angles of a fitted pose whose body stands along `axes`.
JointAngles fitted_angles(const FittedPose& pose, const HumanModel& model,
                          const Eigen::Matrix3f& axes);

}  // namespace limbcast::pose_fitter
