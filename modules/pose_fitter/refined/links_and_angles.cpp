#include "modules/pose_fitter/refined/links_and_angles.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "common/human_model/joint_angles.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Level share of a front that still tells where the body faces [sine of 17 degrees].
constexpr float kLeastLevelFront = 0.3F;
/// Number of Table I's link that ends at the left shoulder.
constexpr int kShoulderLeftLink = 2;

Skeleton skeleton_of(const BodyPose& pose) {
  Skeleton skeleton;
  for (int i = 0; i < kJointCount; ++i) {
    const auto joint = static_cast<Joint>(i);
    if (pose[joint].valid) skeleton.set(joint, pose[joint].position_m);
  }
  return skeleton;
}

void add_link_lengths(const HumanModel& model, BodyPose& pose) {
  for (int number = 1; number < kLinkCount; ++number) {
    const Link& link = model.links[number];
    const JointEstimate& end = pose[link.end];
    const JointEstimate& start = pose[model.links[link.connected_to].end];
    if (start.valid && end.valid)
      pose.link_lengths_m[index(link.end)] = (end.position_m - start.position_m).norm();
  }
}

}  // namespace

void add_links_and_angles(const HumanModel& model, const Eigen::Vector3f& front,
                          const Eigen::Vector3f& down, BodyPose& pose) {
  add_link_lengths(model, pose);
  const Eigen::Vector3f level = front - front.dot(down) * down;
  if (level.norm() < kLeastLevelFront) return;
  Eigen::Matrix3f axes;  // left, up, forward
  axes.col(1) = -down;
  axes.col(2) = level.normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  const float neutral_pitch_rad =
      shoulder_pitch_rad(model.typical_poses.front().directions[kShoulderLeftLink]);
  const JointAngles angles = joint_angles(skeleton_of(pose), axes, model, neutral_pitch_rad);
  std::transform(angles.begin(), angles.end(), pose.angles_rad.begin(),
                 [](const JointAngle& angle) { return angle.rad; });
}

}  // namespace limbcast::pose_fitter::refined
