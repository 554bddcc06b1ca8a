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
/// A body less sure than this is no person. Of bodies that the trees were mostly not trained on,
/// six of 136 things lie over 0.6, three over 0.7, and two of 590 people between. Before scanners
/// nobody lies between 0.65 and 0.75.
constexpr Real kLeastPersonConfidence = 0.7;
/// The trees of the confidence were trained on nobody where the depth's noise is larger [m]: there
/// a body must be surer (a thing 6.7 m from a VGA pair was told with 0.77).
constexpr Real kMostTrainedNoiseM = 0.05, kLeastNoisyPersonConfidence = 0.9;

Real least_confidence(const FittedBody& fitted) {
  const auto distance_m = static_cast<float>(fitted.body.points[kHead].z());
  const bool noisy = fitted.observation.noise.sigma_m(distance_m) > kMostTrainedNoiseM;
  return noisy ? kLeastNoisyPersonConfidence : kLeastPersonConfidence;
}

}  // namespace

std::optional<BodyPose> assess(const FittedBody& fitted) {
  const BodyState& body = fitted.body;
  const Evidence& evidence = fitted.evidence;
  BodyPose pose;
  for (int i = 0; i < kJointCount; ++i) {
    JointEstimate& joint = pose.joints[i];
    joint.position_m = body.points[i].cast<float>();
    joint.confidence = static_cast<float>(joint_confidence(evidence, i));
    joint.sigma_m = static_cast<float>(spread_scale() * evidence.sigma_m[i]);
    joint.valid = joint.confidence >= kLeastJointConfidence;
  }
  for (Pointing& pointing :
       find_pointing(pose, (-fitted.observation.up).cast<float>(), kPointingRule)) {
    const int side = static_cast<int>(pointing.side);
    pointing.confidence = static_cast<float>(direction_confidence(body, side, evidence));
    pointing.sigma_rad = static_cast<float>(spread_scale() * evidence.arms[side].sigma_rad);
    if (pointing.confidence < kLeastArmConfidence) continue;
    // Beside an unsure arm that is straighter and more raised, the other is not the one that
    // points.
    if (pointing.confidence < kLeastPointingConfidence) break;
    pose.pointing.push_back(pointing);
  }
  pose.scale = static_cast<float>(body.stature_m() / kReferenceStatureM);
  pose.confidence = static_cast<float>(person_confidence(fitted));
  if (pose.confidence < least_confidence(fitted)) return std::nullopt;
  return pose;
}

}  // namespace limbcast::pose_fitter::refined
