#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "common/human_model/human_model.hpp"

namespace limbcast {

/// End points of the links, by Joint.
struct Skeleton {
  std::array<Eigen::Vector3f, kJointCount> position_m{};
  std::array<bool, kJointCount> valid{};

  const Eigen::Vector3f& operator[](Joint joint) const { return position_m[index(joint)]; }
  bool has(Joint joint) const { return valid[index(joint)]; }
  void set(Joint joint, const Eigen::Vector3f& position) {
    position_m[index(joint)] = position;
    valid[index(joint)] = true;
  }
};

/// An angle as far as end points tell it.
struct JointAngle {
  float rad = 0.0F;  ///< NaN: a point that it needs was left out
  /// How far the end point moves, in radians of its link's direction, for one radian of this angle:
  /// 1 where it is well seen, near 0 where it is not (the upper arm's rotation of a straight
  /// elbow).
  float leverage = 0.0F;
};
using JointAngles = std::array<JointAngle, kDegreesOfFreedom>;

/// All 28 angles of the model, in the order of joint_limits.json.
///
/// `body` holds the body's axes as columns in the skeleton's frame: left, up, forward; up is
/// against gravity, forward where the whole body faces. A link's direction in the frame of what it
/// hangs on is Rx(-flexion) * Rz(abduction) * down: flexion turns it forward in the sagittal plane
/// (up to 180 degrees, overhead), abduction away from the middle (90 degrees at most). So an arm
/// raised sideways to 135 degrees has flexion 180, abduction 45.
/// - 3 of the shoulders (turn, tilt, pitch): how the triangle neck, left, right shoulder stands to
/// the
///   body; both shoulders are coupled. `neutral_pitch_rad` is its pitch in the typical poses.
/// - 2 of each upper arm or leg against the shoulders' or the pelvis' frame; backs: flexion,
/// lateral.
/// - 2 of each lower arm or leg: the rotation of the upper one about its own axis, seen where the
/// lower
///   one goes (0: the elbow bends forward, the knee backward; the frame moves with the upper one
///   the shortest way), and the bend of elbow or knee.
/// - twists of the backs and the pelvis' turn: end points show only their sum; it is shared out in
///   proportion to the intervals. Pelvis' pitch cannot be seen: 18 % of the legs' mean flexion
///   (Murray et al. 2002).
JointAngles joint_angles(const Skeleton& skeleton, const Eigen::Matrix3f& body,
                         const HumanModel& model, float neutral_pitch_rad);

/// Pitch of the shoulders' triangle when the left one lies in direction `left_shoulder` (body's
/// frame: left, up, forward) of the neck, the right one mirrored.
float shoulder_pitch_rad(const Eigen::Vector3f& left_shoulder);

/// Index of the angle that exceeds its interval most, by more than `tolerance_rad` at the link's
/// end; nothing where all are allowed. Angles that were left out break nothing.
std::optional<int> broken_joint_limit(const JointAngles& angles, const HumanModel& model,
                                      float tolerance_rad);

}  // namespace limbcast
