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
/// A direction less sure than this, or with less to speak for it, is not told.
constexpr Real kLeastPointingConfidence = 0.65;
/// A body less sure than this is no person.
constexpr Real kLeastPersonConfidence = 0.15;
constexpr Real kLeastArmSupport = 3.0, kLeastArmGap = 1.0;
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

Real pointing_confidence(const Evidence& evidence, const ArmEvidence& arm) {
  return logistic(-3.32 + 1.25 * strength(arm.gap) + 1.07 * strength(evidence.flip_gap) -
                  0.55 * std::log(std::max(0.1, arm.sigma_rad / kDegree)) +
                  0.82 * arm.supported_share);
}

/// Furniture fits a body too, but badly or in an odd posture.
Real person_confidence(const BodyState& body, const Evidence& evidence) {
  const Real weight = std::max(1.0, evidence.weight);
  return logistic(10.09 - 4.75 * std::log(std::max(0.1, evidence.prior_cost)) -
                  4.77 * std::min(1.0, evidence.surface_cost / weight) +
                  0.36 * std::log(evidence.free_space_cost / weight + 0.003) +
                  0.39 * std::min(1.5, evidence.head_weight / 15.0) -
                  0.66 * std::abs(std::log(body.stature_m() / 1.65)) + 1.21 * std::log(weight));
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
    if (pointing.confidence < kLeastPointingConfidence || arm.support < kLeastArmSupport ||
        arm.gap < kLeastArmGap) {
      continue;
    }
    pose.pointing.push_back(pointing);
  }
  pose.scale = static_cast<float>(body.stature_m() / kReferenceStatureM);
  pose.confidence = static_cast<float>(person_confidence(body, evidence));
  if (pose.confidence < kLeastPersonConfidence) return std::nullopt;
  return pose;
}

}  // namespace limbcast::pose_fitter::refined
