#include "common/human_model/joint_angles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/shortest_turn.hpp"
#include "common/units.hpp"

namespace limbcast {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

constexpr JointAngle kLeftOut{std::numeric_limits<float>::quiet_NaN(), 0.0F};
/// Share of the hip's flexion that the pelvis does: Murray et al. 2002 (see joint_limits.json).
constexpr float kPelvisShareOfHipFlexion = 0.18F;

// Places of the angles in joint_limits.json.
enum Dof : int {
  kGirdleTurn,
  kGirdleTilt,
  kGirdlePitch,
  kArmLeft,  // flexion, abduction, rotation, elbow
  kArmRight = kArmLeft + 4,
  kUpperBack = kArmRight + 4,  // flexion, lateral, twist
  kLowerBack = kUpperBack + 3,
  kPelvisTurn = kLowerBack + 3,
  kPelvisTilt,
  kPelvisPitch,
  kLegLeft,  // flexion, abduction, rotation, knee
  kLegRight = kLegLeft + 4,
};

Matrix3f about(const Vector3f& axis, float angle_rad) {
  return Eigen::AngleAxisf(angle_rad, axis).toRotationMatrix();
}

float wrapped(float rad) { return std::remainder(rad, 2.0F * kPi<float>); }

/// Flexion and abduction of a direction given in the frame (left, up, forward) it hangs on.
struct Swing {
  JointAngle flexion, abduction;
};

Swing swing_of(const Vector3f& direction) {
  const float sideways = std::clamp(direction.x(), -1.0F, 1.0F);
  const float in_plane = std::hypot(direction.y(), direction.z());
  return {{std::atan2(direction.z(), -direction.y()), in_plane}, {std::asin(sideways), 1.0F}};
}

/// The frame (columns left, up, forward) after the shortest turn that takes its down to
/// `direction`.
Matrix3f swung(const Matrix3f& frame, const Vector3f& direction) {
  const Vector3f down = -frame.col(1);
  return shortest_turn(down, direction).toRotationMatrix() * frame;
}

/// Rotation that takes the body's x axis to `axis` by a turn about up, then a tilt about forward.
struct TurnTilt {
  JointAngle turn, tilt;
  Matrix3f rotation;
};

TurnTilt turn_tilt_of(const Vector3f& axis) {
  const float tilt = std::asin(std::clamp(axis.y(), -1.0F, 1.0F));
  const float turn = std::atan2(-axis.z(), axis.x());
  return {{turn, std::hypot(axis.x(), axis.z())},
          {tilt, 1.0F},
          about(Vector3f::UnitY(), turn) * about(Vector3f::UnitZ(), tilt)};
}

/// Angle of the triangle's middle about the left axis: 0 straight below the neck.
float pitch_of(const Vector3f& middle) { return std::atan2(middle.z(), -middle.y()); }

/// Upper and lower limb of one side; `side_sign` +1 left, -1 right; `bend_sign` +1 the lower one
/// bends forward (arm), -1 backward (leg).
struct LimbJoints {
  Joint root, middle, end;
  float side_sign, bend_sign;
};

void limb_angles(const Skeleton& s, const Matrix3f& frame, const LimbJoints& limb,
                 JointAngle* angles) {
  if (!s.has(limb.root) || !s.has(limb.middle)) return;
  const Vector3f upper = (s[limb.middle] - s[limb.root]).normalized();
  Vector3f local = frame.transpose() * upper;
  local.x() *= limb.side_sign;
  const Swing swing = swing_of(local);
  angles[0] = swing.flexion;
  angles[1] = swing.abduction;
  if (!s.has(limb.end)) return;
  const Vector3f lower = (s[limb.end] - s[limb.middle]).normalized();
  const Vector3f bent = swung(frame, upper).transpose() * lower;
  const float bend = std::acos(std::clamp(-bent.y(), -1.0F, 1.0F));
  // Turned towards the middle of the body is internal, positive.
  const float rotation =
      std::atan2(-limb.side_sign * limb.bend_sign * bent.x(), limb.bend_sign * bent.z());
  // Overhead the shortest way is ill-defined, and so is what counts as rotation 0.
  const float below = std::clamp(1.0F - local.y(), 0.0F, 1.0F);
  angles[2] = {rotation, std::sin(bend) * below};
  angles[3] = {bend, 1.0F};
}

Matrix3f girdle_angles(const Skeleton& s, const Matrix3f& body, float neutral_pitch_rad,
                       JointAngles& angles) {
  if (!s.has(Joint::kNeck) || !s.has(Joint::kShoulderLeft) || !s.has(Joint::kShoulderRight)) {
    return body;
  }
  const Vector3f left = body.transpose() * (s[Joint::kShoulderLeft] - s[Joint::kNeck]);
  const Vector3f right = body.transpose() * (s[Joint::kShoulderRight] - s[Joint::kNeck]);
  const TurnTilt turn_tilt = turn_tilt_of((left - right).normalized());
  const Vector3f middle = turn_tilt.rotation.transpose() * (0.5F * (left + right));
  angles[kGirdleTurn] = turn_tilt.turn;
  angles[kGirdleTilt] = turn_tilt.tilt;
  // The neck lies close to the line of the shoulders: its height over it is the lever.
  const float lever = std::hypot(middle.y(), middle.z()) / (0.5F * (left - right).norm());
  angles[kGirdlePitch] = {wrapped(pitch_of(middle) - neutral_pitch_rad), std::min(1.0F, lever)};
  return body * turn_tilt.rotation;
}

/// Flexion (forward is positive: the lower end goes back) and lateral bend of one link of the back.
Matrix3f back_angles(const Skeleton& s, Joint from, Joint to, const Matrix3f& frame,
                     JointAngle* angles) {
  if (!s.has(from) || !s.has(to)) return frame;
  const Vector3f direction = (s[to] - s[from]).normalized();
  const Swing swing = swing_of(frame.transpose() * direction);
  angles[0] = {-swing.flexion.rad, swing.flexion.leverage};
  angles[1] = swing.abduction;
  return swung(frame, direction);
}

/// Shares the turn between shoulders and hips out over the three angles about the long axis.
void share_twist(const JointAngle& total, const HumanModel& model, JointAngles& angles) {
  constexpr std::array<int, 3> kTwists = {kUpperBack + 2, kLowerBack + 2, kPelvisTurn};
  double range = 0.0;
  for (const int i : kTwists) {
    range += model.degrees_of_freedom[i].max_rad - model.degrees_of_freedom[i].min_rad;
  }
  for (const int i : kTwists) {
    const DegreeOfFreedom& dof = model.degrees_of_freedom[i];
    const auto share = static_cast<float>((dof.max_rad - dof.min_rad) / std::max(range, 1e-9));
    angles[i] = {total.rad * share, total.leverage};
  }
}

float mean_leg_flexion(const Skeleton& s, const Matrix3f& frame) {
  float sum = 0.0F;
  int count = 0;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Joint hip = on_side(Joint::kHipLeft, side), knee = on_side(Joint::kKneeLeft, side);
    if (!s.has(hip) || !s.has(knee)) continue;
    sum += swing_of(frame.transpose() * (s[knee] - s[hip]).normalized()).flexion.rad;
    ++count;
  }
  return count == 0 ? 0.0F : sum / static_cast<float>(count);
}

Matrix3f pelvis_angles(const Skeleton& s, const Matrix3f& back, const HumanModel& model,
                       JointAngles& angles) {
  if (!s.has(Joint::kHipLeft) || !s.has(Joint::kHipRight)) return back;
  const Vector3f axis = (s[Joint::kHipLeft] - s[Joint::kHipRight]).normalized();
  const TurnTilt turn_tilt = turn_tilt_of(back.transpose() * axis);
  share_twist(turn_tilt.turn, model, angles);
  angles[kPelvisTilt] = turn_tilt.tilt;
  const Matrix3f level = back * turn_tilt.rotation;
  const float pitch = kPelvisShareOfHipFlexion * mean_leg_flexion(s, level);
  angles[kPelvisPitch] = {pitch, 1.0F};
  return level * about(Vector3f::UnitX(), -pitch);
}

/// How far `rad` lies outside [min, max], the short way around the circle.
float excess_rad(float rad, const DegreeOfFreedom& dof) {
  const auto middle = static_cast<float>(0.5 * (dof.min_rad + dof.max_rad));
  const auto half = static_cast<float>(0.5 * (dof.max_rad - dof.min_rad));
  return std::max(0.0F, std::abs(wrapped(rad - middle)) - half);
}

}  // namespace

float shoulder_pitch_rad(const Vector3f& left_shoulder) {
  return pitch_of({0.0F, left_shoulder.y(), left_shoulder.z()});
}

JointAngles joint_angles(const Skeleton& s, const Matrix3f& body, const HumanModel& model,
                         float neutral_pitch_rad) {
  JointAngles angles;
  angles.fill(kLeftOut);
  const Matrix3f girdle = girdle_angles(s, body, neutral_pitch_rad, angles);
  limb_angles(s, girdle, {Joint::kShoulderLeft, Joint::kElbowLeft, Joint::kWristLeft, 1.0F, 1.0F},
              &angles[kArmLeft]);
  limb_angles(s, girdle,
              {Joint::kShoulderRight, Joint::kElbowRight, Joint::kWristRight, -1.0F, 1.0F},
              &angles[kArmRight]);
  Matrix3f back = back_angles(s, Joint::kNeck, Joint::kChest, body, &angles[kUpperBack]);
  back = back_angles(s, Joint::kChest, Joint::kPelvis, back, &angles[kLowerBack]);
  const Matrix3f pelvis = pelvis_angles(s, back, model, angles);
  limb_angles(s, pelvis, {Joint::kHipLeft, Joint::kKneeLeft, Joint::kAnkleLeft, 1.0F, -1.0F},
              &angles[kLegLeft]);
  limb_angles(s, pelvis, {Joint::kHipRight, Joint::kKneeRight, Joint::kAnkleRight, -1.0F, -1.0F},
              &angles[kLegRight]);
  return angles;
}

std::optional<int> broken_joint_limit(const JointAngles& angles, const HumanModel& model,
                                      float tolerance_rad) {
  std::optional<int> worst;
  float worst_excess_rad = tolerance_rad;
  for (int i = 0; i < kDegreesOfFreedom; ++i) {
    if (std::isnan(angles[i].rad)) continue;
    const float excess =
        excess_rad(angles[i].rad, model.degrees_of_freedom[i]) * angles[i].leverage;
    if (excess <= worst_excess_rad) continue;
    worst_excess_rad = excess;
    worst = i;
  }
  return worst;
}

}  // namespace limbcast
