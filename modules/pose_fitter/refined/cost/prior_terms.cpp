#include <cmath>

#include "modules/pose_fitter/refined/cost/cost.hpp"
#include "modules/pose_fitter/refined/cost/priors.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

bool of_arm(int point) { return (point >= kShoulder && point < kHip) || point == kHand; }

void add_proportions(int side, bool arm, Priors& priors) {
  for (const Offset& offset : body_offsets()) {
    if (of_arm(offset.point) != arm || offset.point == kShoulder) continue;
    if (side == 1 && !offset.both_sides) continue;
    Vec3 mean = offset.mean;
    if (side == 1) mean.x() = -mean.x();
    // The neck, the pelvis and other middle references have no side.
    const bool paired = offset.reference >= kShoulder;
    priors.offset(offset.point + (offset.both_sides ? side : 0),
                  paired ? offset.reference + side : offset.reference, mean, offset.sigma);
  }
  for (const Bone& bone : bones()) {
    if (of_arm(bone.from) != arm) continue;
    priors.bone(bone.from + side, bone.to + side, bone.length, bone.relative_sigma);
  }
}

void add_shoulder(const BodyState& body, int side, Priors& priors) {
  Vec3 upper_arm =
      body.rotation.transpose() * (body.points[kElbow + side] - body.points[kShoulder + side]);
  upper_arm.normalize();
  upper_arm.x() *= side_sign(side);
  Vec3 mean = shoulder_offset(upper_arm);
  mean.x() *= side_sign(side);
  priors.offset(kShoulder + side, kNeck, mean, shoulder_sigma());
}

void add_arm(const BodyState& body, int side, Priors& priors) {
  add_shoulder(body, side, priors);
  add_proportions(side, true, priors);
  priors.hand(side);
  priors.elbow(side);
  priors.shoulder_limit(side);
}

/// What ties an arm to the rest: the arms' lengths, no limb in another one.
void add_arm_contacts(unsigned parts, Priors& priors) {
  priors.symmetry(kShoulder, kElbow);
  priors.symmetry(kElbow, kWrist);
  for (int side = 0; side < 2; ++side) {
    if ((parts & arm_bit(side)) == 0) continue;
    for (const int point : {kElbow, kWrist, kHand}) priors.outside_trunk(point + side);
  }
  priors.limbs_apart(kElbow, kWrist, kElbow + 1, kWrist + 1);
  priors.limbs_apart(kShoulder, kElbow, kElbow + 1, kWrist + 1);
  priors.limbs_apart(kElbow, kWrist, kShoulder + 1, kElbow + 1);
  priors.limbs_apart(kWrist, kHand, kWrist + 1, kHand + 1);
}

void add_trunk_and_legs(const Observation& observation, const RefinedParams& params,
                        Priors& priors) {
  for (int side = 0; side < 2; ++side) {
    add_proportions(side, false, priors);
    priors.knee(side);
    if (observation.floor_m) priors.ground(side, observation.up, *observation.floor_m);
  }
  priors.symmetry(kHip, kKnee);
  priors.symmetry(kKnee, kAnkle);
  priors.log_stature(std::log(params.mean_stature_m / kReferenceStatureM),
                     params.log_stature_sigma);
  priors.log_girth();
  priors.upright(observation.up);
  priors.head(observation.head_start, observation.head_start_sigma_m);
}

}  // namespace

void add_prior_terms(const BodyState& body, const Cones& cones, const Observation& observation,
                     unsigned parts, const RefinedParams& params, NormalEquations& equations) {
  Priors priors(body, cones, equations);
  const bool trunk = (parts & bit(Part::kTrunk)) != 0;
  if (trunk) add_trunk_and_legs(observation, params, priors);
  for (int side = 0; side < 2; ++side) {
    if ((parts & arm_bit(side)) != 0) {
      add_arm(body, side, priors);
    } else {
      // The shoulder belongs to the trunk; where its arm goes is not known yet.
      priors.offset(kShoulder + side, kNeck, {side_sign(side) * 0.102, -0.0726, 0.0067},
                    {0.007, 0.016, 0.013});
    }
  }
  if ((parts & ~kWithoutArms) != 0) add_arm_contacts(parts, priors);
}

}  // namespace limbcast::pose_fitter::refined
