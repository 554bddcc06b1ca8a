#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "common/human_model/joints.hpp"

namespace limbcast {

/// Where a joint is: its centre inside the body.
struct JointEstimate {
  bool valid = false;  ///< false: left out (not seen, no valid fit); the rest is then meaningless
  Eigen::Vector3f position_m = Eigen::Vector3f::Zero();
  float confidence = 0.0F;  ///< 0 to 1: probability that the position is within 10 cm
  float sigma_m =
      0.0F;  ///< standard deviation of the position along its worst axis [m], 0 = not told
  bool predicted = false;  ///< true: not measured in this frame (tracker)
};

/// An arm that points. Directions are unit vectors in Stamp::frame.
struct Pointing {
  Side side = Side::kLeft;
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();  ///< arm axis: shoulder to wrist
  Eigen::Vector3f forearm = Eigen::Vector3f::Zero();    ///< elbow to wrist
  Eigen::Vector3f head_hand = Eigen::Vector3f::Zero();  ///< head to wrist
  float sigma_rad = 0.0F;   ///< standard deviation of the angle of `direction`, 0 = not told
  float confidence = 0.0F;  ///< 0 to 1: probability that this person points so
};

inline constexpr int kErrorTermCount = 4;
inline constexpr int kDegreesOfFreedom = 28;

inline std::array<float, kDegreesOfFreedom> untold_angles() {
  std::array<float, kDegreesOfFreedom> angles{};
  angles.fill(std::numeric_limits<float>::quiet_NaN());
  return angles;
}

/// Pose of one person.
struct BodyPose {
  std::int32_t id = 0;  ///< BODY_POSES: the segment's; TRACKED_POSES: the person's, over time
  std::array<JointEstimate, kJointCount> joints;
  std::array<float, kJointCount>
      link_lengths_m{};  ///< link i of Table I ends at its joint; 0 = left out
  std::array<float, kDegreesOfFreedom> angles_rad =
      untold_angles();      ///< order: human model file; NaN = left out
  float confidence = 0.0F;  ///< 0 to 1: probability that this is a person in this pose
  float error = 0.0F;       ///< Eq. 1 (paper), or the cost per point (refined)
  std::array<float, kErrorTermCount>
      error_terms{};  ///< Eq. 1: distance, missing links, unused points, density
  std::int32_t typical_pose =
      -1;                     ///< index in the model file of the typical pose that won, -1 = none
  float rotation_deg = 0.0F;  ///< rotation about gravity that won
  float scale = 1.0F;         ///< s of Eq. 2
  std::vector<Pointing> pointing;  ///< none, one or both arms, the most certain first

  const JointEstimate& operator[](Joint joint) const { return joints[index(joint)]; }
  JointEstimate& operator[](Joint joint) { return joints[index(joint)]; }
};

struct BodyPoses {
  Stamp stamp;
  std::vector<BodyPose> persons;
};

}  // namespace limbcast
