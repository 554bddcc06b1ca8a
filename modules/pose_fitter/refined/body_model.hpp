#pragma once

#include <Eigen/Core>
#include <array>

#include "common/human_model/joints.hpp"

/// The articulated body: points that are unknowns, round cones between them, proportions.
namespace limbcast::pose_fitter::refined {

using Real = double;
using Vec3 = Eigen::Matrix<Real, 3, 1>;
using Mat3 = Eigen::Matrix<Real, 3, 3>;

/// Points 0 to 15 are the joints of common/human_model/joints.hpp, in their order.
enum BodyPoint : int {
  kHead,
  kNeck,
  kChest,
  kPelvis,
  kShoulder,
  kElbow = kShoulder + 2,
  kWrist = kElbow + 2,
  kHip = kWrist + 2,
  kKnee = kHip + 2,
  kAnkle = kKnee + 2,
  kHand = kAnkle + 2,
  kToe = kHand + 2,
  kPointCount = kToe + 2,
};
/// kShoulder is the left one, kShoulder + 1 the right one, and so for all pairs.
constexpr int on_side(int left_point, int side) { return left_point + side; }
/// +1 for the person's left, -1 for the right: sign of the body frame's x axis.
constexpr Real side_sign(int side) { return side == 0 ? 1.0 : -1.0; }

/// The unknowns of a body: the points, then these.
enum Unknown : int {
  kLogStature = 3 * kPointCount,
  kLogGirth,
  kRotation,
  kUnknownCount = kRotation + 3,
};

enum class Part : unsigned { kTrunk = 1, kLeftArm = 2, kRightArm = 4, kLegs = 8 };
constexpr unsigned bit(Part part) { return static_cast<unsigned>(part); }
constexpr unsigned arm_bit(int side) {
  return side == 0 ? bit(Part::kLeftArm) : bit(Part::kRightArm);
}
inline constexpr unsigned kAllParts = 15;
inline constexpr unsigned kWithoutArms = bit(Part::kTrunk) | bit(Part::kLegs);

struct Weight {
  int point = 0;
  Real weight = 0.0;
};
/// A point that is a weighted sum of up to three body points.
using Anchor = std::array<Weight, 3>;

/// A round cone: sphere swept from `from` to `to` while its radius changes linearly. Lengths in
/// statures.
struct ConeSpec {
  Anchor from, to;
  Real radius_from = 0.0, radius_to = 0.0;
  Real forward_offset = 0.0;  ///< both ends move so much towards the body's front
  Part part = Part::kTrunk;
  bool grows_with_girth = true;
  bool blocks_arms = false;  ///< the arms may not stand inside it
  bool lower_arm = false;    ///< forearm or hand: what carries the pointing direction
};
inline constexpr int kConeCount = 22;
/// The cone from the wrist to the finger tips.
constexpr int hand_cone(int side) { return side == 0 ? 12 : 18; }
/// Radii and offsets: fitted to frames of the tuning half with true joints and true depth.
const std::array<ConeSpec, kConeCount>& cone_specs();

/// A point's place against another one in the body's frame (x to the person's left, y up, z to the
/// front), with spread, in statures; for the left side, the right one is mirrored.
struct Offset {
  int point, reference;
  bool both_sides;
  Eigen::Vector3d mean, sigma;
};
/// Means of ANSUR-like adult proportions, found again on the tuning half; limbs have wide spreads:
/// rest pose.
const std::array<Offset, 9>& body_offsets();

struct Bone {
  int from, to;  ///< left side
  Real length, relative_sigma;
};
const std::array<Bone, 5>& bones();

/// Where a shoulder stands against the neck when the upper arm points along `upper_arm` (unit, body
/// frame of the left side): the scapula follows the arm.
Eigen::Vector3d shoulder_offset(const Eigen::Vector3d& upper_arm);
Eigen::Vector3d shoulder_sigma();

}  // namespace limbcast::pose_fitter::refined
