#include "modules/pose_fitter/refined/assessment.hpp"

#include <algorithm>
#include <cmath>

#include "modules/pose_fitter/pointing.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

constexpr Real kDegree = M_PI / 180.0;

/// Probabilities are logistic regressions on simulated people and the tuning half of the rendered
/// ones; README.md has the figures. Evidence beyond this many units of cost adds nothing.
constexpr Real kMostEvidence = 30.0;
/// A joint less sure than this is left out.
constexpr Real kLeastJointConfidence = 0.08;
/// A direction less sure than this is not told.
constexpr Real kLeastPointingConfidence = 0.65;
/// A body less sure than this is no person.
constexpr Real kLeastPersonConfidence = 0.3;
/// Posterior spreads are too small, as neighbouring points share their errors: measured error
/// against stated sigma on the tuning half.
constexpr Real kSigmaScale = 1.6;

Real logistic(Real x) { return 1.0 / (1.0 + std::exp(-x)); }
Real strength(Real cost) { return std::log1p(std::clamp(cost, 0.0, kMostEvidence)); }

bool of_lower_arm(int point) { return point >= kElbow && point < kHip; }

Real joint_confidence(const Evidence& evidence, int joint) {
  Real x = -2.99 - 0.78 * std::log(std::max(1e-4, evidence.sigma_m[joint])) +
           (evidence.in_sight[joint] ? 0.17 : 0.0) + 0.89 * strength(evidence.flip_gap);
  if (of_lower_arm(joint)) {
    x += -3.32 + 1.21 * strength(evidence.arms[(joint - kElbow) % 2].gap);
  } else if (joint < kShoulder) {
    x += 2.26;  // head, neck, chest, pelvis stay where they are when the body is flipped
  }
  return logistic(x);
}

/// That the arm axis is right: a straight arm in sight, in a body that fits well, without a rival.
Real pointing_confidence(const Evidence& evidence, const ArmEvidence& arm) {
  const Real sigma_deg = std::max(0.1, arm.sigma_rad / kDegree);
  return logistic(1.65 + 1.23 * strength(arm.gap) + 0.68 * strength(arm.support) -
                  0.50 * std::log(sigma_deg) - 2.01 * arm.bend_rad / (45.0 * kDegree) -
                  0.98 * std::log(std::max(0.1, evidence.prior_cost)) -
                  3.19 * std::min(1.0, evidence.surface_cost / evidence.weight));
}

/// Furniture fits a body too, but in an odd posture, as well from the back, and without limbs of
/// its own.
Real person_confidence(const Evidence& evidence) {
  const Real arms = strength(evidence.arms[0].support) + strength(evidence.arms[1].support);
  return logistic(7.14 - 2.62 * std::log(std::max(0.1, evidence.prior_cost)) -
                  1.34 * std::log(evidence.weight) + 0.90 * strength(evidence.flip_gap) +
                  0.70 * arms + 5.30 * evidence.legs_share);
}

}  // namespace

std::optional<BodyPose> assess(const BodyState& body, const Evidence& evidence,
                               const Observation& observation) {
  BodyPose pose;
  for (int i = 0; i < kJointCount; ++i) {
    JointEstimate& joint = pose.joints[i];
    joint.position_m = body.points[i].cast<float>();
    joint.confidence = static_cast<float>(joint_confidence(evidence, i));
    joint.sigma_m = static_cast<float>(kSigmaScale * evidence.sigma_m[i]);
    joint.valid = joint.confidence >= kLeastJointConfidence;
  }
  for (Pointing& pointing : find_pointing(pose, (-observation.up).cast<float>())) {
    const ArmEvidence& arm = evidence.arms[pointing.side == Side::kLeft ? 0 : 1];
    pointing.confidence = static_cast<float>(pointing_confidence(evidence, arm));
    pointing.sigma_rad = static_cast<float>(kSigmaScale * arm.sigma_rad);
    if (pointing.confidence >= kLeastPointingConfidence) pose.pointing.push_back(pointing);
  }
  pose.scale = static_cast<float>(body.stature_m() / kReferenceStatureM);
  pose.confidence = static_cast<float>(person_confidence(evidence));
  if (pose.confidence < kLeastPersonConfidence) return std::nullopt;
  return pose;
}

}  // namespace limbcast::pose_fitter::refined
