#include "modules/pose_fitter/refined/assessment.hpp"

#include "modules/pose_fitter/refined/confidence.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// A joint less sure than this is left out.
constexpr Real kLeastJointConfidence = 0.08;
/// A direction less sure than this is not told. Of 492 directions on recorded and simulated people
/// six right ones and three wrong ones lie between 0.8 and this.
constexpr Real kLeastPointingConfidence = 0.9;
/// An arm less sure than this is where the body's arm is not.
constexpr Real kLeastArmConfidence = 0.1;
/// A body less sure than this is no person. Of the bodies that the trees were not trained on eight
/// of 787 things and 500 of 581 people lie over it.
constexpr Real kLeastPersonConfidence = 0.7;
/// Before a scanner the surface alone speaks: of 150 simulated rooms three got a person at 0.7, two
/// at 0.8, where two of 141 people are lost; and two things of a real street lie between.
constexpr Real kLeastScannedPersonConfidence = 0.8;
/// The trees of the confidence were trained on nobody where the depth's noise is larger [m]: there
/// a body must be surer (a thing 6.7 m from a VGA pair was told with 0.77).
constexpr Real kMostTrainedNoiseM = 0.05, kLeastNoisyPersonConfidence = 0.9;

/// A camera's noise grows with the distance, a scanner's does not.
bool of_scanner(const Observation& observation) {
  return !observation.has_colors && observation.noise.quadratic_per_m <= 0.0F;
}

Real least_confidence(const FittedBody& fitted) {
  const auto distance_m = static_cast<float>(fitted.body.points[kHead].z());
  if (fitted.observation.noise.sigma_m(distance_m) > kMostTrainedNoiseM)
    return kLeastNoisyPersonConfidence;
  return of_scanner(fitted.observation) ? kLeastScannedPersonConfidence : kLeastPersonConfidence;
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
