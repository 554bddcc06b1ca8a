#include "modules/simulate/arm_poses.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/units.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Vector3d;

/// Where the wrist of a resting or busy arm is: fractions of a mean adult's stature from the neck
/// joint (x outward, y up, z forward), and where its elbow goes. Chosen by eye on rendered figures.
struct ArmHabit {
  Vector3d wrist, spread, pole;
  HandShape hand = HandShape::kOpen;
};

const std::map<std::string, ArmHabit>& arm_habits() {
  static const std::map<std::string, ArmHabit> habits = {
      {"hang", {{0.140, -0.360, 0.045}, {0.020, 0.010, 0.030}, {0.3, 0, -1}}},
      {"akimbo", {{0.120, -0.310, 0.045}, {0.012, 0.015, 0.020}, {1, 0, -0.5}, HandShape::kFist}},
      {"phone", {{0.090, 0.030, 0.060}, {0.010, 0.012, 0.012}, {0.6, -1, 0.2}, HandShape::kFist}},
      {"folded", {{-0.050, -0.155, 0.125}, {0.020, 0.018, 0.008}, {1, -0.7, 0}}},
      {"carry", {{0.075, -0.230, 0.200}, {0.020, 0.040, 0.030}, {0.5, -1, -0.3}}},
      {"drink", {{0.030, 0.020, 0.150}, {0.015, 0.010, 0.015}, {0.6, -1, 0}, HandShape::kFist}},
      {"chin", {{0.020, -0.035, 0.120}, {0.010, 0.008, 0.010}, {0.4, -1, 0}, HandShape::kFist}},
      {"behindhead", {{0.060, 0.075, -0.060}, {0.012, 0.015, 0.010}, {1, 0.3, -0.1}}},
      {"clap", {{0.020, -0.090, 0.190}, {0.008, 0.030, 0.030}, {1, -0.8, 0}}},
      {"back", {{0.010, -0.320, -0.105}, {0.015, 0.015, 0.010}, {1, 0, -0.6}}},
      {"pocket", {{0.125, -0.345, 0.045}, {0.010, 0.010, 0.012}, {0.5, 0, -1}, HandShape::kFist}},
      {"lap", {{0.060, -0.300, 0.150}, {0.025, 0.012, 0.040}, {1, 0, -0.4}}},
      {"texting", {{0.020, -0.120, 0.180}, {0.015, 0.030, 0.030}, {0.5, -1, 0}, HandShape::kFist}},
      {"gesture", {{0.120, -0.130, 0.190}, {0.050, 0.080, 0.050}, {0.6, -1, -0.2}}},
  };
  return habits;
}

ArmPose habitual(Rng& rng, const BodyShape& body, const std::string& name) {
  const ArmHabit& habit = arm_habits().at(name);
  Vector3d wrist = habit.wrist;
  for (int axis = 0; axis < 3; ++axis) wrist[axis] += rng.normal(0.0, habit.spread[axis]);
  const double trunk = (body.pelvis_chest_m + body.chest_neck_m) / 0.343;
  const double up = wrist.y() > 0.0 ? body.neck_head_m / 0.076 : trunk;
  const double girth = 0.5 * body.stature_m * (1.0 + std::max(body.trunk_girth, body.waist_girth)) +
                       1.5 * body.clothes.torso_m;
  wrist = Vector3d(wrist.x() * girth, wrist.y() * up, wrist.z() * girth + 0.5 * body.belly_m);
  if (name == "hang") wrist *= (body.upper_arm_m + body.forearm_m) / (0.299 * body.stature_m);
  ArmPose arm = reach(body, wrist, habit.pole);
  arm.hand = habit.hand;
  arm.hand_bend_rad = rng.normal(0.1, 0.15);
  arm.hand_roll_rad = rng.normal(0.0, 0.4);
  return arm;
}

ArmPose bent(Rng& rng, const Vector3d& upper, const Vector3d& fore, HandShape hand) {
  ArmPose arm;
  arm.upper = (upper + 0.12 * Vector3d{rng.normal(), rng.normal(), rng.normal()}).normalized();
  arm.fore = (fore + 0.15 * Vector3d{rng.normal(), rng.normal(), rng.normal()}).normalized();
  arm.hand = hand;
  arm.hand_roll_rad = rng.normal(0.0, 0.4);
  return arm;
}

/// Any arm within the joints' limits: elbow 0 to 145 degrees, not far behind the back.
ArmPose any_arm(Rng& rng) {
  ArmPose arm;
  const double azimuth = rng.uniform(-35.0, 120.0);
  const double elevation = std::asin(rng.uniform(-1.0, 0.95)) * 180.0 / kPi<double>;
  arm.upper = heading(azimuth, elevation);
  const double bend = radians(rng.uniform(0.0, 145.0));
  // The forearm folds forward and up, turned by the upper arm's roll.
  const Vector3d side =
      (heading(azimuth, elevation + 90.0) + 0.8 * rng.normal() * Vector3d(-1.0, 0.0, 0.3))
          .normalized();
  const Vector3d across = (side - arm.upper * arm.upper.dot(side)).normalized();
  arm.fore = std::cos(bend) * arm.upper + std::sin(bend) * across;
  arm.hand = static_cast<HandShape>(rng.pick(2));
  arm.hand_roll_rad = rng.normal(0.0, 0.6);
  return arm;
}

struct Range {
  double low, high;
};

/// A stretched arm with an open hand whose angles [degrees] lie in these ranges.
ArmPose any_stretched_arm(Rng& rng, const BodyShape& body, Range azimuth, Range elevation,
                          Range bend) {
  const double bend_deg = rng.uniform(bend.low, bend.high);
  const double elevation_deg = rng.uniform(elevation.low, elevation.high);
  const double azimuth_deg = rng.uniform(azimuth.low, azimuth.high);
  return stretched_arm(rng, body, heading(azimuth_deg, elevation_deg), bend_deg, HandShape::kOpen);
}

}  // namespace

Vector3d heading(double azimuth_deg, double elevation_deg) {
  const double a = radians(azimuth_deg);
  const double e = radians(elevation_deg);
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

ArmPose stretched_arm(Rng& rng, const BodyShape& body, const Vector3d& direction, double bend_deg,
                      HandShape hand) {
  const double a = body.upper_arm_m;
  const double b = body.forearm_m;
  const double length = std::sqrt(a * a + b * b + 2.0 * a * b * std::cos(radians(bend_deg)));
  ArmPose arm;
  arm.upper = direction;
  for (int i = 0; i < 3; ++i) {  // the shoulder follows the upper arm
    arm = reach(body, shoulder_offset_m(body, arm.upper) + length * direction,
                {0.5 + rng.normal(0.0, 0.2), -1.0, -0.3});
  }
  arm.hand = hand;
  arm.hand_bend_rad = rng.normal(0.0, 0.10);
  arm.hand_roll_rad = rng.normal(0.0, 0.5);
  return arm;
}

ArmPose draw_arm(Rng& rng, const BodyShape& body, const std::string& name) {
  if (name == "wave") return bent(rng, {0.85, -0.35, 0.35}, {0.25, 1.0, 0.2}, HandShape::kOpen);
  if (name == "raise") return any_stretched_arm(rng, body, {20, 90}, {55, 80}, {5, 40});
  if (name == "T") {
    const double bend = rng.uniform(0, 8);
    const double elevation = rng.normal(0, 7);
    const double azimuth = 90 + rng.normal(0, 8);
    return stretched_arm(rng, body, heading(azimuth, elevation), bend, HandShape::kOpen);
  }
  if (name == "reachF") return any_stretched_arm(rng, body, {-10, 40}, {-25, 15}, {5, 50});
  if (name == "reachU") return any_stretched_arm(rng, body, {-10, 50}, {25, 60}, {5, 45});
  if (name == "any") return any_arm(rng);
  return habitual(rng, body, name);
}

}  // namespace limbcast::simulate
