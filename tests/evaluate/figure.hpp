#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "common/human_model/body_pose.hpp"

namespace limbcast::evaluate {

/// A person of 16 known joints at `x_m`, 3 m away: stands upright, right arm hangs, left arm
/// stretched to the left, all joints visible. As truth (confidence 1 = visible) or as report (all
/// certain).
inline BodyPose standing_figure(float x_m = 0.0F) {
  BodyPose person;
  const auto set = [&](Joint joint, float x, float y, float z) {
    person[joint] = {true, {x_m + x, y, 3.0F + z}, 1.0F, 0.0F, false};
  };
  set(Joint::kHead, 0.0F, -0.6F, 0.0F);
  set(Joint::kNeck, 0.0F, -0.4F, 0.0F);
  set(Joint::kChest, 0.0F, -0.1F, 0.0F);
  set(Joint::kPelvis, 0.0F, 0.2F, 0.0F);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const float sign = side == Side::kLeft ? 1.0F : -1.0F;
    set(on_side(Joint::kShoulderLeft, side), 0.18F * sign, -0.35F, 0.0F);
    set(on_side(Joint::kHipLeft, side), 0.1F * sign, 0.2F, 0.0F);
    set(on_side(Joint::kKneeLeft, side), 0.1F * sign, 0.6F, 0.0F);
    set(on_side(Joint::kAnkleLeft, side), 0.1F * sign, 1.0F, 0.0F);
  }
  set(Joint::kElbowRight, -0.18F, -0.05F, 0.0F);
  set(Joint::kWristRight, -0.18F, 0.2F, 0.0F);
  set(Joint::kElbowLeft, 0.48F, -0.35F, 0.0F);
  set(Joint::kWristLeft, 0.73F, -0.35F, 0.0F);
  return person;
}

/// The same with the left arm hanging too.
inline BodyPose resting_figure(float x_m = 0.0F) {
  BodyPose person = standing_figure(x_m);
  person[Joint::kElbowLeft].position_m = {x_m + 0.18F, -0.05F, 3.0F};
  person[Joint::kWristLeft].position_m = {x_m + 0.18F, 0.2F, 3.0F};
  return person;
}

/// Left arm along x, turned by `off_deg` about the viewing axis.
inline Pointing left_arm(float off_deg = 0.0F) {
  const float angle = off_deg / 57.2957795F;
  Pointing arm;
  arm.side = Side::kLeft;
  arm.direction = {std::cos(angle), std::sin(angle), 0.0F};
  arm.forearm = arm.direction;
  arm.head_hand = arm.direction;
  arm.confidence = 1.0F;
  return arm;
}

inline BodyPose pointing_figure(float off_deg = 0.0F) {
  BodyPose person = standing_figure();
  person.pointing.push_back(left_arm(off_deg));
  return person;
}

inline void move(BodyPose& person, const Eigen::Vector3f& by_m) {
  for (JointEstimate& joint : person.joints) joint.position_m += by_m;
}

inline BodyPoses frame(std::vector<BodyPose> persons, std::int64_t utime = 1) {
  BodyPoses poses;
  poses.stamp.utime = utime;
  poses.persons = std::move(persons);
  return poses;
}

}  // namespace limbcast::evaluate
