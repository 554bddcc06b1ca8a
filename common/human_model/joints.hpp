#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace limbcast {

/// The 16 link end points of the paper's model (Table I), the person's own left and right.
enum class Joint : int {
  kHead,
  kNeck,
  kChest,
  kPelvis,
  kShoulderLeft,
  kShoulderRight,
  kElbowLeft,
  kElbowRight,
  kWristLeft,
  kWristRight,
  kHipLeft,
  kHipRight,
  kKneeLeft,
  kKneeRight,
  kAnkleLeft,
  kAnkleRight,
};
inline constexpr int kJointCount = 16;

/// Names as in JSON, ground truth and lcm-spy; index is the value of Joint.
inline constexpr std::array<std::string_view, kJointCount> kJointNames = {
    "head",       "neck",        "chest",      "pelvis",      "shoulder_left", "shoulder_right",
    "elbow_left", "elbow_right", "wrist_left", "wrist_right", "hip_left",      "hip_right",
    "knee_left",  "knee_right",  "ankle_left", "ankle_right"};

enum class Side : int { kLeft = 0, kRight = 1 };

constexpr int index(Joint joint) { return static_cast<int>(joint); }
/// The joint of that side where `left` is the one of the left side.
constexpr Joint on_side(Joint left, Side side) {
  return static_cast<Joint>(index(left) + static_cast<int>(side));
}
/// The joint in the mirror: the other side's, or itself where there is one only.
constexpr int mirrored(int joint) {
  constexpr int kFirstOfTwo = index(Joint::kShoulderLeft);
  return joint < kFirstOfTwo ? joint : ((joint - kFirstOfTwo) ^ 1) + kFirstOfTwo;
}
/// Joint of that name, nothing for an unknown name.
std::optional<Joint> joint_from_name(std::string_view name);

}  // namespace limbcast
