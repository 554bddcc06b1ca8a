#include "modules/simulate/motion.hpp"

#include <algorithm>
#include <cmath>

#include "common/shortest_turn.hpp"
#include "common/units.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Vector3d;

constexpr double kWalk_s = 3.0;  // until a walker stops
constexpr double kMove_s = 0.7;  // from one posture to the next
constexpr double kHold_s = 1.2;  // at each thing pointed at
constexpr double kSitDown_s = 1.3;
constexpr double kWave_Hz = 1.2;

/// 0 before `start_s`, 1 after `start_s + duration_s`, smooth between.
double progress(double seconds, double start_s, double duration_s) {
  const double share = std::clamp((seconds - start_s) / duration_s, 0.0, 1.0);
  return share * share * (3.0 - 2.0 * share);
}

MotionKind drawn(MotionKind kind, Rng& rng) {
  return kind == MotionKind::kAny ? static_cast<MotionKind>(1 + rng.pick(4)) : kind;
}

double middle_of_feet_z(const BodyShape& body, const Posture& posture) {
  const Skeleton skeleton = make_skeleton(body, posture, {0.0, 0.0, kPi<double>});  // forward is +z
  return 0.5 * (skeleton[Joint::kAnkleLeft].z() + skeleton[Joint::kAnkleRight].z());
}

}  // namespace

Posture between(const Posture& from, const Posture& to, double share) {
  const auto mixed = [share](double a, double b) { return (1.0 - share) * a + share * b; };
  const auto turned = [share](const Vector3d& a, const Vector3d& b) {
    return Vector3d(Eigen::Quaterniond::Identity().slerp(share, shortest_turn(a, b)) *
                    a.normalized());
  };
  Posture result = share < 1.0 ? from : to;
  result.pelvis_lean_rad = mixed(from.pelvis_lean_rad, to.pelvis_lean_rad);
  result.lean_rad = mixed(from.lean_rad, to.lean_rad);
  result.side_lean_rad = mixed(from.side_lean_rad, to.side_lean_rad);
  result.twist_rad = mixed(from.twist_rad, to.twist_rad);
  result.head_yaw_rad = mixed(from.head_yaw_rad, to.head_yaw_rad);
  result.head_pitch_rad = mixed(from.head_pitch_rad, to.head_pitch_rad);
  result.head_roll_rad = mixed(from.head_roll_rad, to.head_roll_rad);
  for (int side = 0; side < 2; ++side) {
    result.arms[side].upper = turned(from.arms[side].upper, to.arms[side].upper);
    result.arms[side].fore = turned(from.arms[side].fore, to.arms[side].fore);
    result.legs[side].thigh = turned(from.legs[side].thigh, to.legs[side].thigh);
    result.legs[side].shank = turned(from.legs[side].shank, to.legs[side].shank);
    result.legs[side].foot_pitch_rad =
        mixed(from.legs[side].foot_pitch_rad, to.legs[side].foot_pitch_rad);
  }
  return result;
}

Motion::Motion(MotionKind kind, const BodyShape& body, const Place& place,
               const PointingParams& pointing, Rng rng)
    : kind_(drawn(kind, rng)), body_(body), place_(place) {
  PointingParams standing = pointing;
  standing.seated_share = 0.0;
  switch (kind_) {
    case MotionKind::kAny:
    case MotionKind::kWalkPoint:
      stations_.push_back(draw_pointing(rng, body, standing));
      break;
    case MotionKind::kWave:
      stations_.push_back(draw_posture(rng, body, "hang"));
      stations_.push_back(stations_.front());
      waving_side_ = rng.pick(2);
      stations_.back().name = "wave";
      stations_.back().arms[waving_side_].upper = Vector3d(0.85, -0.25, 0.35).normalized();
      stations_.back().arms[waving_side_].fore = Vector3d(0.25, 1.0, 0.2).normalized();
      break;
    case MotionKind::kPointAround: {
      stations_.push_back(draw_pointing(rng, body, standing));
      while (stations_.size() < 3) {  // the legs stay, the same arm points elsewhere
        const Posture next = draw_pointing(rng, body, standing);
        if (next.pointing_side != stations_.front().pointing_side) continue;
        stations_.push_back(stations_.front());
        stations_.back().arms[next.pointing_side] = next.arms[next.pointing_side];
        stations_.back().head_yaw_rad = next.head_yaw_rad;
      }
      break;
    }
    case MotionKind::kSitDown:
      stations_.push_back(draw_posture(rng, body, "hang"));
      stations_.push_back(draw_posture(rng, body, "sit"));
      break;
  }
}

double Motion::walked_m(double seconds) const {
  return kind_ == MotionKind::kWalkPoint ? 0.45 * body_.stature_m * std::min(seconds, kWalk_s)
                                         : 0.0;
}

Posture Motion::posture(double seconds) const {
  if (kind_ == MotionKind::kWalkPoint) {
    const double step_m = 0.41 * body_.stature_m;
    const Posture walk = walking(body_, kPi<double> * walked_m(seconds) / step_m);
    return between(walk, stations_.front(), progress(seconds, kWalk_s, kMove_s));
  }
  if (kind_ == MotionKind::kSitDown) {
    return between(stations_[0], stations_[1], progress(seconds, 1.0, kSitDown_s));
  }
  if (kind_ == MotionKind::kWave) {
    Posture posture = between(stations_[0], stations_[1], progress(seconds, 0.3, kMove_s));
    const double swing =
        progress(seconds, 0.3 + kMove_s, 0.3) * std::sin(2.0 * kPi<double> * kWave_Hz * seconds);
    ArmPose& arm = posture.arms[waving_side_];
    arm.fore = Eigen::AngleAxisd(0.45 * swing, Vector3d::UnitZ()) * arm.fore;
    return posture;
  }
  const double period_s = kHold_s + kMove_s;
  const auto last = static_cast<int>(stations_.size()) - 1;
  const int at = std::min(last, static_cast<int>(seconds / period_s));
  return between(stations_[at], stations_[std::min(last, at + 1)],
                 progress(seconds - at * period_s, kHold_s, kMove_s));
}

Place Motion::place(double seconds) const {
  double forward_m = walked_m(seconds) - walked_m(kWalk_s);
  if (kind_ == MotionKind::kSitDown) {  // the feet stay, the hips go back
    forward_m = middle_of_feet_z(body_, stations_[0]) - middle_of_feet_z(body_, posture(seconds));
  }
  Place place = place_;
  place.x_m -= forward_m * std::sin(place_.yaw_rad);
  place.z_m -= forward_m * std::cos(place_.yaw_rad);
  return place;
}

}  // namespace limbcast::simulate
