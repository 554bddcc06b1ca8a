#include "modules/simulate/posture_parts.hpp"

#include <algorithm>

#include "modules/simulate/arm_poses.hpp"
#include "modules/simulate/body_surface.hpp"

namespace limbcast::simulate {

using Eigen::Vector3d;

void stand(Rng& rng, Posture& posture) {
  const double apart = rng.uniform(0.0, 0.10);
  for (LegPose& leg : posture.legs) {
    leg.thigh = {apart + rng.normal(0.0, 0.03), -1.0, rng.normal(0.0, 0.05)};
    leg.shank = {apart + rng.normal(0.0, 0.02), -1.0, leg.thigh.z() - 0.12 + rng.normal(0.0, 0.04)};
    leg.foot_yaw_rad = rng.normal(0.2, 0.12);
  }
  if (rng.chance(0.3)) {  // the weight on one leg, the other one loose
    LegPose& loose = posture.legs[rng.pick(2)];
    loose.thigh.z() += 0.25;
    loose.shank.z() -= 0.15;
  }
}

void sit(Rng& rng, Posture& posture) {
  posture.seated = true;
  const double spread = rng.uniform(0.02, 0.35);
  const double slope = rng.normal(-0.05, 0.10);
  for (LegPose& leg : posture.legs) {
    leg.thigh = {spread + rng.normal(0.0, 0.05), slope, 1.0};
    leg.shank = {rng.normal(0.0, 0.06), -1.0, rng.normal(0.0, 0.18)};
    leg.foot_yaw_rad = rng.normal(0.15, 0.12);
  }
  posture.lean_rad = rng.normal(-0.05, 0.15);
}

void move_trunk(Rng& rng, Posture& posture) {
  posture.lean_rad += rng.normal(0.02, 0.06);
  posture.side_lean_rad = rng.normal(0.0, 0.04);
  posture.twist_rad = rng.normal(0.0, 0.10);
  posture.head_yaw_rad = std::clamp(rng.normal(0.0, 0.35), -1.1, 1.1);
  posture.head_pitch_rad = std::clamp(rng.normal(0.05, 0.20), -0.6, 0.7);
  posture.head_roll_rad = rng.normal(0.0, 0.08);
}

double arm_clearance_m(const BodyShape& body, const Posture& posture, Side side) {
  const Skeleton skeleton = make_skeleton(body, posture, {});
  const Surface surface = make_body_surface(body, posture, skeleton, 1);
  const int s = static_cast<int>(side);
  const Vector3d& elbow = skeleton[on_side(Joint::kElbowLeft, side)];
  const Vector3d& wrist = skeleton[on_side(Joint::kWristLeft, side)];
  double clearance = 1.0;
  for (const Vector3d& point :
       {elbow, Vector3d(0.7 * elbow + 0.3 * wrist), Vector3d(0.4 * elbow + 0.6 * wrist), wrist,
        skeleton.hand[s], Vector3d(0.4 * skeleton.hand[s] + 0.6 * skeleton.fingertip[s])}) {
    for (const Primitive& primitive : surface.primitives) {
      const bool own = primitive.part == on_side(Part::kUpperArmLeft, s) ||
                       primitive.part == on_side(Part::kForearmLeft, s) ||
                       primitive.part == on_side(Part::kHandLeft, s);
      if (!own) clearance = std::min<double>(clearance, primitive.distance_m(point.cast<float>()));
    }
  }
  return clearance;
}

double set_clear_arm(const BodyShape& body, Side side, Posture& posture,
                     const std::function<ArmPose()>& draw) {
  constexpr double kEnough =
      0.012;  // the middle of a wrist lies 2.5 cm under its skin; flesh gives way
  double best = -1.0;
  ArmPose best_arm;
  for (int attempt = 0; attempt < 30 && best < kEnough; ++attempt) {
    posture.arms[static_cast<int>(side)] = draw();
    const double clearance = arm_clearance_m(body, posture, side);
    if (clearance <= best) continue;
    best = clearance;
    best_arm = posture.arms[static_cast<int>(side)];
  }
  posture.arms[static_cast<int>(side)] = best_arm;
  return best;
}

void set_arm(Rng& rng, const BodyShape& body, const std::string& name, Side side,
             Posture& posture) {
  const double clearance =
      set_clear_arm(body, side, posture, [&] { return draw_arm(rng, body, name); });
  if (clearance < 0.0 && name != "hang") set_arm(rng, body, "hang", side, posture);
}

}  // namespace limbcast::simulate
