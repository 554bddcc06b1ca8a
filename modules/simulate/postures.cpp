#include "modules/simulate/postures.hpp"

#include <algorithm>
#include <cmath>

#include "common/units.hpp"
#include "modules/simulate/arm_poses.hpp"
#include "modules/simulate/body_surface.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Vector3d;

/// Draws an arm until it goes through nothing; after 30 draws the best so far. Its clearance [m].
template <class Draw>
double set_clear_arm(const BodyShape& body, Side side, Posture& posture, const Draw& draw) {
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

/// Bends from hips and waist, as to pick something up or to rise from a seat.
Posture bowing(Rng& rng, const BodyShape& body) {
  Posture posture;
  posture.name = "bow";
  stand(rng, posture);
  const double bow_rad = rng.uniform(0.6, 1.6);  // a back that is level, and a little more
  const double of_hips = rng.uniform(0.5, 0.7);
  move_trunk(rng, posture);
  posture.pelvis_lean_rad = of_hips * bow_rad;
  posture.lean_rad += (1.0 - of_hips) * bow_rad;
  posture.head_pitch_rad -= rng.uniform(0.0, 0.5) * bow_rad;  // most look ahead
  for (LegPose& leg : posture.legs) {
    leg.thigh.z() += rng.uniform(0.1, 0.6);  // hips go back as the head goes forward
    leg.shank.z() -= rng.uniform(0.0, 0.4);
  }
  const double straight_down_deg = bow_rad * kDegreesPerRadian<double> - 90.0;  // for the trunk
  const auto hanging = [&] {
    const double elevation_deg = straight_down_deg + rng.normal(0.0, 15.0);
    const double azimuth_deg = rng.uniform(-15.0, 35.0), bend_deg = rng.uniform(0.0, 40.0);
    return stretched_arm(rng, body, heading(azimuth_deg, elevation_deg), bend_deg,
                         HandShape::kOpen);
  };
  static const char* const kBusy[] = {"lap", "akimbo", "back", "reachF", "texting"};
  for (const Side side : {Side::kLeft, Side::kRight}) {
    if (rng.chance(0.3)) {
      set_arm(rng, body, kBusy[rng.pick(5)], side, posture);
    } else {
      set_clear_arm(body, side, posture, hanging);
    }
  }
  return posture;
}

/// On both knees or on one, upright or sitting on the heels.
void kneel(Rng& rng, Posture& posture) {
  const bool on_one = rng.chance(0.5);
  const double back = on_one ? 0.0 : rng.uniform(0.0, 1.2);  // of who sits on the heels
  const int front = rng.pick(2);
  for (int side = 0; side < 2; ++side) {
    LegPose& leg = posture.legs[side];
    if (on_one && side == front) {
      leg.thigh = {0.15 + rng.normal(0.0, 0.08), rng.normal(0.15, 0.05), 1.0};
      leg.shank = {rng.normal(0.0, 0.08), -1.0, rng.normal(0.0, 0.15)};
      continue;
    }
    leg.thigh = {0.1 + rng.normal(0.0, 0.06), -1.0, back + rng.normal(0.0, 0.08)};
    const bool on_toes = rng.chance(0.5);  // or the instep on the ground
    leg.shank = {rng.normal(0.0, 0.08), on_toes ? 0.3 : 0.0, -1.0};
    leg.foot_pitch_rad = on_toes ? rng.uniform(1.2, 1.5) : rng.uniform(2.6, 3.0);
  }
  posture.lean_rad = rng.uniform(-0.05, 0.5);
}

/// On the ground, legs stretched, drawn up or crossed.
void sit_on_floor(Rng& rng, Posture& posture) {
  const double kind = rng.uniform();
  for (LegPose& leg : posture.legs) {
    if (kind < 0.35) {  // stretched
      leg.thigh = {0.15 + rng.normal(0.0, 0.1), rng.uniform(0.0, 0.4), 1.0};
      leg.shank = {rng.normal(0.0, 0.08), -leg.thigh.y() - 0.1, 1.0};
      leg.foot_pitch_rad = -rng.uniform(0.8, 1.4);
    } else if (kind < 0.7) {  // drawn up
      leg.thigh = {0.1 + rng.normal(0.0, 0.12), rng.uniform(0.7, 1.3), 1.0};
      leg.shank = {rng.normal(0.0, 0.08), -1.0, rng.normal(0.1, 0.2)};
    } else {  // crossed
      leg.thigh = {rng.uniform(0.6, 1.0), rng.uniform(0.0, 0.3), 1.0};
      leg.shank = {-1.0, -0.25, rng.uniform(-0.3, 0.2)};
    }
  }
  posture.lean_rad = rng.uniform(-0.2, 0.5);
}

/// Something that hides most of the trunk, or of the face: a board, a poster, a crate.
HeldThing draw_held_thing(Rng& rng, const BodyShape& body, bool seated) {
  HeldThing thing;
  const bool is_crate = rng.chance(0.35);
  thing.size_m.x() = is_crate ? rng.uniform(0.25, 0.6) : rng.uniform(0.3, 0.95);
  thing.size_m.y() = is_crate ? rng.uniform(0.2, 0.5) : rng.uniform(0.25, 0.75);
  thing.size_m.z() = is_crate ? rng.uniform(0.15, 0.4) : rng.uniform(0.004, 0.03);
  // Smaller people hold smaller things, and nearer.
  const double scale = body.stature_m / 1.75;
  thing.size_m *= scale;
  const double front_m = 0.07 * body.stature_m * std::max(body.trunk_girth, body.waist_girth) +
                         body.belly_m + 1.5 * body.clothes.torso_m;
  thing.middle_m.z() = front_m + rng.uniform(0.04, 0.25) * scale + 0.5 * thing.size_m.z();
  thing.middle_m.x() = rng.normal(0.0, 0.03);
  thing.middle_m.y() = rng.uniform(-0.4, is_crate ? -0.1 : 0.12) * scale;
  if (seated) {  // over the thighs
    thing.middle_m.y() = std::max(thing.middle_m.y(), -0.34 * scale + 0.5 * thing.size_m.y());
  }
  thing.tilt_rad = rng.normal(0.0, 0.15);
  return thing;
}

/// With both hands, at its sides or at its lower edge.
Posture holding(Rng& rng, const BodyShape& body) {
  Posture posture;
  posture.name = "hold";
  if (rng.chance(0.2)) {
    sit(rng, posture);
  } else {
    stand(rng, posture);
  }
  move_trunk(rng, posture);
  const HeldThing thing = draw_held_thing(rng, body, posture.seated);
  posture.held = thing;
  const bool from_below = rng.chance(0.3);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const double inward = side == Side::kLeft ? 1.0 : -1.0;
    const double half_width =
        thing.size_m.x() * (from_below ? rng.uniform(0.25, 0.4) : 0.5) + (from_below ? 0.0 : 0.03);
    const double up =
        from_below ? -0.5 * thing.size_m.y() - 0.03 : rng.uniform(-0.45, 0.2) * thing.size_m.y();
    const Vector3d wrist(half_width + inward * thing.middle_m.x(), thing.middle_m.y() + up,
                         thing.middle_m.z() + rng.normal(-0.03, 0.02));
    set_clear_arm(body, side, posture, [&] {
      ArmPose arm = reach(body, wrist, {rng.uniform(0.3, 1.0), -1.0, rng.uniform(-0.5, 0.0)});
      arm.hand_bend_rad = rng.normal(0.1, 0.2);
      arm.hand_roll_rad = rng.normal(0.0, 0.3);
      return arm;
    });
  }
  return posture;
}

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
