#include "modules/simulate/rare_postures.hpp"

#include <algorithm>

#include "common/units.hpp"
#include "modules/simulate/arm_poses.hpp"
#include "modules/simulate/posture_parts.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Vector3d;

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

}  // namespace

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

}  // namespace limbcast::simulate
