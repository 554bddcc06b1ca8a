#include "modules/pose_fitter/refined/body_model.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

std::array<ConeSpec, kConeCount> make_cones() {
  std::array<ConeSpec, kConeCount> cones;
  std::size_t count = 0;
  const auto add = [&](Part part, const Anchor& from, const Anchor& to, Real radius_from,
                       Real radius_to, Real forward) -> ConeSpec& {
    cones[count] = {from, to,   radius_from,          radius_to, forward,
                    part, true, part == Part::kTrunk, false};
    return cones[count++];
  };
  const auto whole = [](int point) { return Anchor{{{point, 1.0}}}; };

  ConeSpec& head = add(Part::kTrunk, {{{kHead, 0.75}, {kNeck, 0.25}}},
                       {{{kHead, 1.05}, {kNeck, -0.05}}}, 0.0560, 0.0532, 0.0048);
  head.grows_with_girth = false;
  ConeSpec& neck =
      add(Part::kTrunk, whole(kNeck), {{{kNeck, 0.5}, {kShoulder, 0.25}, {kShoulder + 1, 0.25}}},
          0.0311, 0.0365, 0.0017);
  neck.blocks_arms = false;
  for (int side = 0; side < 2; ++side) {
    const int shoulder = on_side(kShoulder, side), other = on_side(kShoulder, 1 - side);
    const int hip = on_side(kHip, side);
    const Anchor waist = {{{kChest, 1.0}, {hip, 0.7}, {kPelvis, -0.7}}};
    ConeSpec& trapezius = add(Part::kTrunk, {{{shoulder, 0.6}, {other, 0.4}}},
                              {{{shoulder, 0.95}, {other, 0.05}}}, 0.0526, 0.0433, -0.0107);
    trapezius.blocks_arms = false;
    add(Part::kTrunk, {{{shoulder, 0.6}, {other, 0.15}, {kChest, 0.25}}}, waist, 0.0625, 0.0605,
        -0.0081);
    add(Part::kTrunk, waist, {{{hip, 0.75}, {kPelvis, 0.25}}}, 0.0458, 0.0573, 0.0092);
  }
  add(Part::kTrunk, {{{kShoulder, 0.35}, {kShoulder + 1, 0.35}, {kChest, 0.3}}}, whole(kChest),
      0.0582, 0.0756, -0.0023);
  add(Part::kTrunk, whole(kChest), whole(kPelvis), 0.0651, 0.0711, 0.0087);
  for (int side = 0; side < 2; ++side) {
    const Part arm = side == 0 ? Part::kLeftArm : Part::kRightArm;
    const auto limb = [&](Part part, int from, int to, Real radius_from, Real radius_to,
                          Real forward) -> ConeSpec& {
      return add(part, whole(on_side(from, side)), whole(on_side(to, side)), radius_from, radius_to,
                 forward);
    };
    limb(arm, kShoulder, kElbow, 0.0348, 0.0243, 0.0);
    limb(arm, kElbow, kWrist, 0.0252, 0.0167, 0.0).lower_arm = true;
    ConeSpec& hand = limb(arm, kWrist, kHand, 0.0150, 0.0260, 0.0);
    hand.to = {{{on_side(kHand, side), 1.4}, {on_side(kWrist, side), -0.4}}};
    hand.lower_arm = true;
    limb(Part::kLegs, kHip, kKnee, 0.0577, 0.0383, 0.0128);
    limb(Part::kLegs, kKnee, kAnkle, 0.0382, 0.0350, -0.0079);
    limb(Part::kLegs, kAnkle, kToe, 0.0250, 0.0200, 0.0);
  }
  return cones;
}

}  // namespace

const std::array<ConeSpec, kConeCount>& cone_specs() {
  static const std::array<ConeSpec, kConeCount> cones = make_cones();
  return cones;
}

const std::array<Offset, 9>& body_offsets() {
  static const std::array<Offset, 9> offsets = {{
      {kHead, kNeck, false, {0.0, 0.075, 0.016}, {0.012, 0.006, 0.012}},
      {kChest, kNeck, false, {0.0, -0.161, 0.017}, {0.005, 0.006, 0.006}},
      {kPelvis, kNeck, false, {0.0, -0.3465, 0.0}, {0.008, 0.010, 0.008}},
      {kHip, kPelvis, true, {0.061, 0.0, 0.0}, {0.003, 0.004, 0.004}},
      {kToe, kAnkle, true, {0.02, -0.03, 0.095}, {0.04, 0.02, 0.03}},
      {kKnee, kHip, true, {0.01, -0.2, 0.05}, {0.10, 0.2, 0.2}},
      {kAnkle, kKnee, true, {0.005, -0.245, -0.03}, {0.08, 0.15, 0.12}},
      {kElbow, kShoulder, true, {0.03, -0.12, 0.0}, {0.28, 0.28, 0.28}},
      {kWrist, kElbow, true, {0.0, -0.07, 0.05}, {0.336, 0.336, 0.336}},
  }};
  return offsets;
}

const std::array<Bone, 5>& bones() {
  static const std::array<Bone, 5> all = {{
      {kShoulder, kElbow, 0.147, 0.03},
      {kElbow, kWrist, 0.1465, 0.055},
      {kHip, kKnee, 0.2385, 0.035},
      {kKnee, kAnkle, 0.250, 0.045},
      {kAnkle, kToe, 0.105, 0.08},
  }};
  return all;
}

Eigen::Vector3d shoulder_offset(const Eigen::Vector3d& upper_arm) {
  // Linear regression on the truth of the tuning half (bodies D1-D3); leaves 5 mm of 16 mm
  // vertically.
  const Real left = upper_arm.x(), up = upper_arm.y(), forward = upper_arm.z();
  return {0.0962 + 0.0023 * left - 0.0025 * up + 0.0080 * forward,
          -0.0602 + 0.0009 * left + 0.0225 * up + 0.0022 * forward,
          0.0074 - 0.0216 * left - 0.0068 * up + 0.0079 * forward};
}

Eigen::Vector3d shoulder_sigma() { return {0.006, 0.0025, 0.012}; }

}  // namespace limbcast::pose_fitter::refined
