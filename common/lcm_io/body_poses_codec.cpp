#include "common/lcm_io/body_poses_codec.hpp"

#include <algorithm>
#include <cmath>

#include "common/lcm_io/message_error.hpp"
#include "common/lcm_io/plausible.hpp"
#include "common/lcm_io/stamp_codec.hpp"

namespace limbcast::lcm_io {
namespace {

void write_vector(const Eigen::Vector3f& vector, float* out) {
  for (int i = 0; i < 3; ++i) out[i] = vector[i];
}

Eigen::Vector3f read_vector(const float* in) {
  const Eigen::Vector3f vector(in[0], in[1], in[2]);
  require(is_plausible(vector), "body poses: a coordinate is not finite or out of range");
  return vector;
}

/// A unit vector; zero where the direction is not known.
Eigen::Vector3f read_direction(const float* in) {
  constexpr float kUnitTolerance = 0.01F;
  const Eigen::Vector3f direction = read_vector(in);
  require(direction.isZero() || std::abs(direction.norm() - 1.0F) < kUnitTolerance,
          "body poses: a direction is no unit vector");
  return direction;
}

joint_t to_message(const JointEstimate& joint, int joint_index) {
  joint_t message{};
  message.name = std::string(kJointNames[joint_index]);
  if (!joint.valid) return message;
  message.valid = 1;
  message.predicted = joint.predicted ? 1 : 0;
  write_vector(joint.position_m, message.position_m);
  message.confidence = joint.confidence;
  message.sigma_m = joint.sigma_m;
  return message;
}

JointEstimate from_message(const joint_t& message, int joint_index) {
  require(message.name == kJointNames[joint_index],
          "body poses: a joint has another name than its place says");
  JointEstimate joint;
  if (message.valid == 0) return joint;
  joint.valid = true;
  joint.predicted = message.predicted != 0;
  joint.position_m = read_vector(message.position_m);
  require(is_share(message.confidence) && is_size(message.sigma_m),
          "body poses: confidence or sigma is out of range");
  joint.confidence = message.confidence;
  joint.sigma_m = message.sigma_m;
  return joint;
}

pointing_t to_message(const Pointing& pointing) {
  pointing_t message{};
  message.side = pointing.side == Side::kLeft ? pointing_t::LEFT : pointing_t::RIGHT;
  write_vector(pointing.direction, message.direction);
  write_vector(pointing.forearm, message.forearm);
  write_vector(pointing.head_hand, message.head_hand);
  message.sigma_rad = pointing.sigma_rad;
  message.confidence = pointing.confidence;
  return message;
}

Pointing from_message(const pointing_t& message) {
  require(message.side == pointing_t::LEFT || message.side == pointing_t::RIGHT,
          "body poses: unknown side");
  Pointing pointing;
  pointing.side = message.side == pointing_t::LEFT ? Side::kLeft : Side::kRight;
  pointing.direction = read_direction(message.direction);
  pointing.forearm = read_direction(message.forearm);
  pointing.head_hand = read_direction(message.head_hand);
  require(is_size(message.sigma_rad) && is_share(message.confidence),
          "body poses: uncertainty of a direction is out of range");
  pointing.sigma_rad = message.sigma_rad;
  pointing.confidence = message.confidence;
  return pointing;
}

body_pose_t to_message(const BodyPose& pose) {
  body_pose_t message{};
  message.id = pose.id;
  for (int i = 0; i < kJointCount; ++i) message.joints[i] = to_message(pose.joints[i], i);
  std::copy(pose.link_lengths_m.begin(), pose.link_lengths_m.end(), message.link_lengths_m);
  std::copy(pose.angles_rad.begin(), pose.angles_rad.end(), message.angles_rad);
  std::copy(pose.error_terms.begin(), pose.error_terms.end(), message.error_terms);
  message.confidence = pose.confidence;
  message.error = pose.error;
  message.typical_pose = pose.typical_pose;
  message.rotation_deg = pose.rotation_deg;
  message.scale = pose.scale;
  for (const Pointing& pointing : pose.pointing) message.pointing.push_back(to_message(pointing));
  message.num_pointing = static_cast<std::int32_t>(message.pointing.size());
  return message;
}

BodyPose from_message(const body_pose_t& message) {
  BodyPose pose;
  pose.id = message.id;
  for (int i = 0; i < kJointCount; ++i) pose.joints[i] = from_message(message.joints[i], i);
  std::copy_n(message.link_lengths_m, kJointCount, pose.link_lengths_m.begin());
  std::copy_n(message.angles_rad, kDegreesOfFreedom, pose.angles_rad.begin());
  std::copy_n(message.error_terms, kErrorTermCount, pose.error_terms.begin());
  require(std::all_of(pose.link_lengths_m.begin(), pose.link_lengths_m.end(), is_size),
          "body poses: a link's length is out of range");
  require(std::none_of(pose.angles_rad.begin(), pose.angles_rad.end(),
                       [](float angle_rad) { return std::isinf(angle_rad); }),
          "body poses: an angle is infinite");
  require(
      std::isfinite(message.error) && std::all_of(pose.error_terms.begin(), pose.error_terms.end(),
                                                  [](float term) { return std::isfinite(term); }),
      "body poses: error is not finite");
  require(
      is_share(message.confidence) && is_size(message.scale) && std::isfinite(message.rotation_deg),
      "body poses: confidence, scale or rotation of a person is out of range");
  pose.confidence = message.confidence;
  pose.error = message.error;
  pose.typical_pose = message.typical_pose;
  pose.rotation_deg = message.rotation_deg;
  pose.scale = message.scale;
  for (const pointing_t& pointing : message.pointing)
    pose.pointing.push_back(from_message(pointing));
  return pose;
}

}  // namespace

body_poses_t to_message(const BodyPoses& poses) {
  body_poses_t message{};
  message.stamp = to_message(poses.stamp);
  for (const BodyPose& person : poses.persons) message.persons.push_back(to_message(person));
  message.num_persons = static_cast<std::int32_t>(message.persons.size());
  return message;
}

BodyPoses from_message(const body_poses_t& message) {
  BodyPoses poses;
  poses.stamp = from_message(message.stamp);
  for (const body_pose_t& person : message.persons) poses.persons.push_back(from_message(person));
  return poses;
}

}  // namespace limbcast::lcm_io
