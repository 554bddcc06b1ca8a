#include "modules/pose_fitter/refined/assessment.hpp"

#include <algorithm>
#include <cmath>

#include "modules/pose_fitter/pointing.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

constexpr Real kDegree = M_PI / 180.0;

/// Probabilities are logistic regressions on simulated people and the tuning half of the rendered
/// ones; README.md has the figures. Evidence beyond this many units of cost adds nothing.
constexpr Real kMostEvidence = 30.0, kMostGap = 15.0;
/// A joint less sure than this is left out.
constexpr Real kLeastJointConfidence = 0.08;
/// A direction less sure than this is not told.
constexpr Real kLeastPointingConfidence = 0.8;
/// Arms that point to the ground before one's feet are raised by 60 degrees and more; up to 35 they
/// hang.
constexpr PointingParams kPointingRule{/*max_elbow_bend_deg=*/45.0, /*min_raise_deg=*/45.0};
/// A body less sure than this is no person.
constexpr Real kLeastPersonConfidence = 0.6;
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
Real pointing_confidence(const BodyState& body, const Evidence& evidence, const ArmEvidence& arm) {
  const Real sigma_deg = std::max(0.1, arm.sigma_rad / kDegree);
  // The cost is per area of skin, of which a child has less.
  const Real size = kReferenceStatureM / body.stature_m();
  return logistic(3.73 + 0.24 * std::clamp(arm.gap * size * size, 0.0, kMostGap) +
                  0.85 * strength(arm.support) - 0.79 * std::log(sigma_deg) -
                  3.27 * arm.bend_rad / (45.0 * kDegree) -
                  1.24 * std::log(std::max(0.1, evidence.prior_cost)) -
                  4.38 * std::min(1.0, evidence.surface_cost / evidence.weight));
}

/// Furniture fits a body too, but in an odd posture, as well from the back, and without limbs of
/// its own.
Real person_confidence(const Evidence& evidence) {
  const Real arms = strength(evidence.arms[0].support) + strength(evidence.arms[1].support);
  return logistic(3.41 - 2.73 * std::log(std::max(0.1, evidence.prior_cost)) +
                  1.03 * strength(evidence.flip_gap) + 0.42 * arms + 1.76 * evidence.legs_share);
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
  for (Pointing& pointing : find_pointing(pose, (-observation.up).cast<float>(), kPointingRule)) {
    const ArmEvidence& arm = evidence.arms[pointing.side == Side::kLeft ? 0 : 1];
    pointing.confidence = static_cast<float>(pointing_confidence(body, evidence, arm));
    pointing.sigma_rad = static_cast<float>(kSigmaScale * arm.sigma_rad);
    // Beside an unsure arm that is straighter and more raised, the other is not the one that
    // points.
    if (pointing.confidence < kLeastPointingConfidence) break;
    pose.pointing.push_back(pointing);
  }
  pose.scale = static_cast<float>(body.stature_m() / kReferenceStatureM);
  pose.confidence = static_cast<float>(person_confidence(evidence));
  if (pose.confidence < kLeastPersonConfidence) return std::nullopt;
  return pose;
}

}  // namespace limbcast::pose_fitter::refined
