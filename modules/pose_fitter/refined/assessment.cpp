#include "modules/pose_fitter/refined/assessment.hpp"

#include "modules/pose_fitter/refined/confidence.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// A joint less sure than this is left out.
constexpr Real kLeastJointConfidence = 0.08;
/// A direction less sure than this is not told.
constexpr Real kLeastPointingConfidence = 0.8;
/// An arm less sure than this is where the body's arm is not.
constexpr Real kLeastArmConfidence = 0.1;
/// A body less sure than this is no person.
constexpr Real kLeastPersonConfidence = 0.5;

}  // namespace

std::optional<BodyPose> assess(const BodyState& body, const Evidence& evidence,
                               const Observation& observation) {
  BodyPose pose;
  for (int i = 0; i < kJointCount; ++i) {
    JointEstimate& joint = pose.joints[i];
    joint.position_m = body.points[i].cast<float>();
    joint.confidence = static_cast<float>(joint_confidence(evidence, i));
    joint.sigma_m = static_cast<float>(spread_scale() * evidence.sigma_m[i]);
    joint.valid = joint.confidence >= kLeastJointConfidence;
  }
  for (Pointing& pointing : find_pointing(pose, (-observation.up).cast<float>(), kPointingRule)) {
    const ArmEvidence& arm = evidence.arms[pointing.side == Side::kLeft ? 0 : 1];
    pointing.confidence = static_cast<float>(direction_confidence(body, arm, evidence));
    pointing.sigma_rad = static_cast<float>(spread_scale() * arm.sigma_rad);
    if (pointing.confidence < kLeastArmConfidence) continue;
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
