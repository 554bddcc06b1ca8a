#include "modules/simulate/postures.hpp"

#include <algorithm>
#include <cmath>

#include "common/units.hpp"
#include "modules/simulate/arm_poses.hpp"
#include "modules/simulate/posture_parts.hpp"
#include "modules/simulate/rare_postures.hpp"

namespace limbcast::simulate {
namespace {

struct Habit {
  std::string name, left, right;  ///< what the arms do; left and right swap at random
  double weight;
};

const std::vector<Habit>& habits() {
  static const std::vector<Habit> list = {
      {"hang", "hang", "hang", 10},
      {"akimbo", "akimbo", "akimbo", 6},
      {"akimbo1", "akimbo", "hang", 4},
      {"phone", "phone", "hang", 7},
      {"folded", "folded", "folded", 6},
      {"carry", "carry", "carry", 7},
      {"wave", "wave", "hang", 7},
      {"raise1", "raise", "hang", 5},
      {"raise2", "raise", "raise", 4},
      {"reachF", "reachF", "hang", 5},
      {"reachU", "reachU", "hang", 5},
      {"T", "T", "T", 4},
      {"halfT", "T", "hang", 3},
      {"behindhead", "behindhead", "behindhead", 4},
      {"clap", "clap", "clap", 4},
      {"back", "back", "back", 4},
      {"pocket", "pocket", "pocket", 4},
      {"drink", "drink", "hang", 4},
      {"chin", "chin", "folded", 3},
      {"texting", "texting", "texting", 4},
      {"gesture", "gesture", "gesture", 6},
      {"any", "any", "any", 12},
  };
  return list;
}

}  // namespace

const std::vector<std::string>& natural_posture_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const Habit& habit : habits()) result.push_back(habit.name);
    for (const char* name : {"walk", "sit", "squat", "lean", "bow", "kneel", "floor", "hold"})
      result.emplace_back(name);
    return result;
  }();
  return names;
}

Posture walking(const BodyShape& body, double phase_rad) {
  Posture posture;
  posture.name = "walk";
  posture.lean_rad = 0.05;
  for (int side = 0; side < 2; ++side) {
    const double phase = phase_rad + (side == 0 ? 0.0 : kPi<double>);
    const double swing = radians(24.0) * std::sin(phase);
    // The knee bends most while the leg comes forward.
    const double knee =
        radians(8.0) + radians(48.0) * std::pow(std::max(0.0, std::cos(phase - 0.4)), 2);
    LegPose& leg = posture.legs[side];
    leg.thigh = {0.03, -std::cos(swing), std::sin(swing)};
    leg.shank = {0.02, -std::cos(swing - knee), std::sin(swing - knee)};
    leg.foot_pitch_rad = std::max(0.0, 0.6 * (knee - swing) - 0.15);
    const double arm = -0.8 * swing;
    posture.arms[side].upper = {0.16, -std::cos(arm), std::sin(arm)};
    posture.arms[side].fore = {0.08, -std::cos(arm + 0.35), std::sin(arm + 0.35)};
    posture.arms[side].upper.x() += 1.5 * body.clothes.torso_m;
  }
  posture.twist_rad = -0.10 * std::sin(phase_rad);
  return posture;
}

Posture draw_posture(Rng& rng, const BodyShape& body, const std::string& name) {
  Posture posture;
  if (name == "walk") {
    posture = walking(body, rng.uniform(0.0, 2.0 * kPi<double>));
    move_trunk(rng, posture);
    return posture;
  }
  if (name == "bow") return bowing(rng, body);
  if (name == "hold") return holding(rng, body);
  std::string arms[2] = {"hang", "hang"};
  if (name == "sit") {
    sit(rng, posture);
    static const char* const kBusy[] = {"lap",     "lap",     "lap",  "folded", "phone",
                                        "gesture", "texting", "wave", "reachF"};
    for (std::string& arm : arms) arm = kBusy[rng.pick(9)];
  } else {
    stand(rng, posture);
    for (const Habit& habit : habits()) {
      if (habit.name != name) continue;
      arms[0] = habit.left;
      arms[1] = habit.right;
      if (rng.chance(0.5)) std::swap(arms[0], arms[1]);
    }
  }
  if (name == "squat") {
    for (LegPose& leg : posture.legs) {
      leg.thigh = {rng.uniform(0.1, 0.5), -0.3, 1.0};
      leg.shank = {0.0, -1.0, -0.6};
    }
    posture.lean_rad = 0.5;
    arms[0] = arms[1] = "gesture";
  } else if (name == "lean") {
    posture.lean_rad = rng.uniform(0.3, 0.9);
    arms[0] = arms[1] = "reachF";
  }
  if (name == "kneel" || name == "floor") {
    name == "kneel" ? kneel(rng, posture) : sit_on_floor(rng, posture);
    static const char* const kBusy[] = {"lap",  "hang",   "gesture", "reachF",
                                        "wave", "folded", "texting", "carry"};
    for (std::string& arm : arms) arm = kBusy[rng.pick(8)];
  }
  posture.name = name;
  move_trunk(rng, posture);
  set_arm(rng, body, arms[0], Side::kLeft, posture);
  set_arm(rng, body, arms[1], Side::kRight, posture);
  return posture;
}

Posture draw_natural(Rng& rng, const BodyShape& body) {
  static const double total = [] {
    double sum = 12 + 16 + 2 + 4;  // walk, sit, squat, lean
    for (const Habit& habit : habits()) sum += habit.weight;
    return sum;
  }();
  double draw = rng.uniform(0.0, total);
  for (const Habit& habit : habits()) {
    draw -= habit.weight;
    if (draw < 0.0) return draw_posture(rng, body, habit.name);
  }
  return draw_posture(rng, body,
                      draw < 12   ? "walk"
                      : draw < 28 ? "sit"
                      : draw < 30 ? "squat"
                                  : "lean");
}

Posture draw_pointing(Rng& rng, const BodyShape& body, const PointingParams& params) {
  Posture posture;
  if (rng.chance(params.seated_share)) {
    sit(rng, posture);
  } else {
    stand(rng, posture);
  }
  move_trunk(rng, posture);
  posture.name = "pointing";
  const auto side = static_cast<Side>(rng.pick(2));
  posture.pointing_side = static_cast<int>(side);
  static const char* const kOther[] = {"hang",   "hang",  "hang",    "akimbo", "pocket",
                                       "folded", "phone", "gesture", "back"};
  const char* other = kOther[rng.pick(9)];
  set_arm(rng, body, posture.seated ? "lap" : other,
          side == Side::kLeft ? Side::kRight : Side::kLeft, posture);

  double best = -1.0;
  Posture best_posture = posture;
  for (int attempt = 0; attempt < 30 && best < 0.02; ++attempt) {
    const double azimuth = rng.uniform(-params.max_inward_deg, params.max_outward_deg);
    const double elevation = rng.uniform(params.min_elevation_deg, params.max_elevation_deg);
    const double bend = rng.uniform(0.0, params.max_bend_deg);
    const HandShape hand = rng.chance(0.8) ? HandShape::kPointing : HandShape::kOpen;
    posture.arms[static_cast<int>(side)] =
        stretched_arm(rng, body, heading(azimuth, elevation), bend, hand);
    if (rng.chance(0.6)) {  // most people look where they point
      posture.head_yaw_rad =
          radians(std::clamp(0.75 * (side == Side::kLeft ? azimuth : -azimuth), -65.0, 65.0));
      posture.head_pitch_rad = radians(-0.5 * elevation);
    }
    const double clearance = arm_clearance_m(body, posture, side);
    if (clearance <= best) continue;
    best = clearance;
    best_posture = posture;
  }
  return best_posture;
}

}  // namespace limbcast::simulate
