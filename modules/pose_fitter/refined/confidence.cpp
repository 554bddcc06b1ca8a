#include "modules/pose_fitter/refined/confidence.hpp"

#include <algorithm>
#include <cmath>

#include "common/units.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

#include "modules/pose_fitter/refined/confidence_coefficients.inc"

/// Evidence beyond this many units of cost adds nothing.
constexpr Real kMostEvidence = 30.0, kMostGap = 15.0;
constexpr Real kLeastPriorCost = 0.1, kLeastSigmaM = 1e-4, kLeastSigmaDeg = 0.1;

Real strength(Real cost) { return std::log1p(std::clamp(cost, 0.0, kMostEvidence)); }
/// A posture or a surface that costs much tells of parts in wrong places.
Real odd_posture(const Evidence& evidence) {
  return std::log(std::max(kLeastPriorCost, evidence.prior_cost));
}
Real surface_misfit(const Evidence& evidence) { return evidence.surface_cost / evidence.weight; }

bool of_lower_arm(int point) { return point >= kElbow && point < kHip; }
/// Head, neck, chest and pelvis stay where they are when the body is flipped.
bool on_axis(int point) { return point < kShoulder; }

template <int count>
Real probability(const Features<count>& features, const Real (&coefficients)[count]) {
  const Real log_odds = features.dot(Eigen::Map<const Features<count>>(coefficients));
  return 1.0 / (1.0 + std::exp(-log_odds));
}

}  // namespace

JointFeatures joint_features(const Evidence& evidence, int joint) {
  const bool lower_arm = of_lower_arm(joint);
  JointFeatures features;
  features << 1.0, std::log(std::max(kLeastSigmaM, evidence.sigma_m[joint])),
      evidence.in_sight[joint] ? 1.0 : 0.0, odd_posture(evidence), surface_misfit(evidence),
      lower_arm ? 1.0 : 0.0, lower_arm ? strength(evidence.arms[(joint - kElbow) % 2].gap) : 0.0,
      on_axis(joint) ? 1.0 : 0.0, on_axis(joint) ? 0.0 : strength(evidence.flip_gap);
  return features;
}

DirectionFeatures direction_features(const BodyState& body, const ArmEvidence& arm,
                                     const Evidence& evidence) {
  // The cost is per area of skin, of which a child has less.
  const Real size = kReferenceStatureM / body.stature_m();
  DirectionFeatures features;
  features << 1.0, std::clamp(arm.gap * size * size, 0.0, kMostGap), strength(arm.support),
      std::log(std::max(kLeastSigmaDeg, arm.sigma_rad * kDegreesPerRadian<Real>)), arm.bend_rad,
      odd_posture(evidence), std::min(1.0, surface_misfit(evidence)), arm.forwards,
      std::max(0.0, -arm.outwards);
  return features;
}

PersonFeatures person_features(const Evidence& evidence) {
  PersonFeatures features;
  features << 1.0, odd_posture(evidence), strength(evidence.shape_flip_gap),
      strength(evidence.arms[0].support) + strength(evidence.arms[1].support), evidence.legs_share,
      evidence.head_odds;
  return features;
}

Real joint_confidence(const Evidence& evidence, int joint) {
  return probability(joint_features(evidence, joint), kJointCoefficients);
}

Real direction_confidence(const BodyState& body, const ArmEvidence& arm, const Evidence& evidence) {
  return probability(direction_features(body, arm, evidence), kDirectionCoefficients);
}

Real person_confidence(const Evidence& evidence) {
  return probability(person_features(evidence), kPersonCoefficients);
}

Real spread_scale() { return kSpreadScale; }

}  // namespace limbcast::pose_fitter::refined
