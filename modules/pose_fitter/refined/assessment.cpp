#include "modules/pose_fitter/refined/assessment.hpp"

#include <algorithm>
#include <cmath>

#include "modules/pose_fitter/pointing.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

constexpr Real kDegree = M_PI / 180.0;

/// Probabilities are logistic regressions on simulated people and all the rendered ones of
/// stereo_dev; README.md has the figures. Evidence beyond this many units of cost adds nothing.
constexpr Real kMostEvidence = 30.0, kMostGap = 15.0;
/// A joint less sure than this is left out.
constexpr Real kLeastJointConfidence = 0.08;
/// A direction less sure than this is not told.
constexpr Real kLeastPointingConfidence = 0.8;
/// In the truth, arms that point bend by less than 15 degrees and are raised by more than 60; those
/// up to 35 hang. Half way, with room for measuring errors.
constexpr PointingParams kPointingRule{/*max_elbow_bend_deg=*/45.0, /*min_raise_deg=*/45.0};
/// A body less sure than this is no person.
constexpr Real kLeastPersonConfidence = 0.5;
/// Posterior spreads are too small, as neighbouring points share their errors: root mean square of
/// error over spread, of 242 right directions on the chain's segments (1.47 of 254 with true
/// masks).
constexpr Real kSigmaScale = 1.6;

Real logistic(Real x) { return 1.0 / (1.0 + std::exp(-x)); }
Real strength(Real cost) { return std::log1p(std::clamp(cost, 0.0, kMostEvidence)); }

bool of_lower_arm(int point) { return point >= kElbow && point < kHip; }

/// A posture or a surface that costs much tells of parts in wrong places.
Real misfit(const Evidence& evidence) {
  return 1.98 * std::log(std::max(0.1, evidence.prior_cost)) +
         4.00 * evidence.surface_cost / evidence.weight;
}

Real joint_confidence(const Evidence& evidence, int joint) {
  Real x = -5.15 - 2.35 * std::log(std::max(1e-4, evidence.sigma_m[joint])) +
           (evidence.in_sight[joint] ? 0.95 : 0.0) - misfit(evidence);
  if (of_lower_arm(joint)) x += -1.00 + 0.56 * strength(evidence.arms[(joint - kElbow) % 2].gap);
  // Head, neck, chest and pelvis stay where they are when the body is flipped.
  x += joint < kShoulder ? 3.99 : 0.83 * strength(evidence.flip_gap);
  return logistic(x);
}

/// That the arm axis is right: a straight arm in sight, in a body that fits well, without a rival.
Real pointing_confidence(const BodyState& body, const Evidence& evidence, const ArmEvidence& arm) {
  const Real sigma_deg = std::max(0.1, arm.sigma_rad / kDegree);
  // The cost is per area of skin, of which a child has less.
  const Real size = kReferenceStatureM / body.stature_m();
  return logistic(3.07 + 0.24 * std::clamp(arm.gap * size * size, 0.0, kMostGap) +
                  0.75 * strength(arm.support) - 0.75 * std::log(sigma_deg) -
                  3.10 * arm.bend_rad / (45.0 * kDegree) -
                  0.95 * std::log(std::max(0.1, evidence.prior_cost)) -
                  3.76 * std::min(1.0, evidence.surface_cost / evidence.weight));
}

/// Furniture fits a body too, but in an odd posture, as well from the back, and without limbs of
/// its own and with a doubtful head.
Real person_confidence(const Evidence& evidence) {
  const Real arms = strength(evidence.arms[0].support) + strength(evidence.arms[1].support);
  return logistic(-0.18 - 2.07 * std::log(std::max(0.1, evidence.prior_cost)) +
                  0.61 * strength(evidence.shape_flip_gap) + 0.54 * arms +
                  2.46 * evidence.legs_share + 0.82 * evidence.head_odds);
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
