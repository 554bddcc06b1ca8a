#include "modules/pose_fitter/paper/skeleton.hpp"

namespace limbcast::pose_fitter {

Skeleton skeleton_of(const FittedPose& pose, const HumanModel& model) {
  Skeleton skeleton;
  for (int number = 0; number < kLinkCount; ++number) {
    if (pose.links[number].valid) skeleton.set(model.links[number].end, pose.links[number].end_m);
  }
  return skeleton;
}

JointAngles fitted_angles(const FittedPose& pose, const HumanModel& model,
                          const Eigen::Matrix3f& axes) {
  const auto& directions = model.typical_poses[pose.typical_pose].directions;
  return joint_angles(skeleton_of(pose, model), axes, model, shoulder_pitch_rad(directions[2]));
}

}  // namespace limbcast::pose_fitter
