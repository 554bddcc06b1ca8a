#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>

#include "common/human_model/joints.hpp"
#include "modules/simulate/body.hpp"

namespace limbcast::simulate {

enum class HandShape { kOpen, kFist, kPointing };

/// Directions are unit vectors in the chest's frame seen from the arm's own side: x outward, y up,
/// z forward.
struct ArmPose {
  Eigen::Vector3d upper{0.15, -0.98, 0.05};
  Eigen::Vector3d fore{0.1, -0.95, 0.2};
  double hand_bend_rad = 0.0;  ///< of the wrist, towards the palm
  double hand_roll_rad = 0.0;  ///< about the forearm; 0 = thumb as far up or forward as it goes
  HandShape hand = HandShape::kOpen;
};

/// Directions seen from the leg's own side: x outward, y up, z forward, level however the pelvis
/// leans.
struct LegPose {
  Eigen::Vector3d thigh{0.06, -1.0, 0.0};
  Eigen::Vector3d shank{0.05, -1.0, -0.17};
  double foot_yaw_rad = 0.15;   ///< toes outward
  double foot_pitch_rad = 0.0;  ///< toes down
};

/// A board or crate that is held before the trunk or the face. Chest's frame: x to the own left, y
/// up, z forward.
struct HeldThing {
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();    ///< width, height, thickness
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();  ///< from the neck joint
  double tilt_rad = 0.0;                               ///< its upper edge away from the body
};

/// A pose without a place: what the joints of a body do.
struct Posture {
  std::string name = "hang";
  double pelvis_lean_rad = 0.0;  ///< of the pelvis, forward, and the trunk with it
  double lean_rad = 0.0;         ///< of the trunk on the pelvis, forward
  double side_lean_rad = 0.0;    ///< to the own left
  double twist_rad = 0.0;        ///< of the chest on the pelvis, to the own left
  double head_yaw_rad = 0.0, head_pitch_rad = 0.0,
         head_roll_rad = 0.0;   ///< to the own left, down, to the own left
  std::array<ArmPose, 2> arms;  ///< index: Side
  std::array<LegPose, 2> legs;
  std::optional<HeldThing> held;
  bool seated = false;
  int pointing_side = -1;  ///< value of Side, -1 = points with no arm
};

/// Where a person stands. World: x to the camera's left, y up, z away from the camera, ground at y
/// = 0.
struct Place {
  double x_m = 0.0, z_m = 3.0;
  double yaw_rad = 0.0;  ///< 0 = faces the camera, positive = turned towards the image's right
};

/// Joint centres and frames of the limbs in one frame of reference.
struct Skeleton {
  std::array<Eigen::Vector3d, kJointCount> joints;
  Eigen::Vector3d head_top, eye;
  std::array<Eigen::Vector3d, 2> hand, fingertip, toe;
  Eigen::Matrix3d pelvis_R, chest_R, head_R;  ///< columns: own left, up, forward
  std::array<Eigen::Matrix3d, 2>
      hand_R;  ///< columns: towards the thumb, along the fingers, out of the back
  std::array<Eigen::Matrix3d, 2> foot_R;  ///< columns: own left, up, along the toes

  const Eigen::Vector3d& operator[](Joint joint) const { return joints[index(joint)]; }
  Eigen::Vector3d& operator[](Joint joint) { return joints[index(joint)]; }
};

/// Shoulder joint relative to the neck joint, in the chest's frame of that side (x outward, y up, z
/// forward), for an upper arm in the direction `upper`: the shoulder blade goes with the arm.
Eigen::Vector3d shoulder_offset_m(const BodyShape& body, const Eigen::Vector3d& upper);

/// The arm whose wrist lies at `wrist_m` (relative to the neck joint, frame of ArmPose) or as near
/// as it reaches; the elbow lies towards `pole`.
ArmPose reach(const BodyShape& body, const Eigen::Vector3d& wrist_m, const Eigen::Vector3d& pole);

/// Joints of `body` in `posture`, its lowest part (a foot, a knee or the seat) on the ground, in
/// the world's frame. Who is seated has the feet on it.
Skeleton make_skeleton(const BodyShape& body, const Posture& posture, const Place& place);

/// Of the lowest part of its hips, on which it sits.
double seat_height_m(const BodyShape& body, const Skeleton& skeleton);

/// The same skeleton in another frame.
Skeleton transformed(const Skeleton& skeleton, const Eigen::Isometry3d& target_from_source);

/// Angle between upper arm and forearm's continuation: 0 = straight [rad].
double elbow_bend_rad(const Skeleton& skeleton, Side side);
/// Unit vector shoulder to wrist.
Eigen::Vector3d arm_axis(const Skeleton& skeleton, Side side);

}  // namespace limbcast::simulate
