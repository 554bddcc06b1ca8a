#include "modules/pose_fitter/refined/confidence/assessment.hpp"

#include <algorithm>

#include "modules/pose_fitter/refined/confidence/confidence.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// A joint less sure than this is left out.
constexpr Real kLeastJointConfidence = 0.08;
/// A direction less sure than this is not told. Of simulated people who point (seeds not trained
/// on) nine directions that lie between this and 0.8 are right and one is wrong, between 0.7 and
/// this five and three.
constexpr Real kLeastPointingConfidence = 0.75;
/// Beside an unsure arm that is straighter and more raised an arm must be surer: of simulated
/// people (13 seeds) four such directions that lie between 0.9 and this are right and two are
/// wrong; all of four over this are right (6 seeds).
constexpr Real kLeastOtherArmConfidence = 0.98;
/// An arm less sure than this is where the body's arm is not.
constexpr Real kLeastArmConfidence = 0.1;
/// A body less sure than this is no person. Of 1883 people in 30 sets, most of them of seeds that
/// the trees were not trained on, and 732 rooms 1731 people and six things are told, four people
/// and one thing more from 0.65 on.
constexpr Real kLeastPersonConfidence = 0.75;
/// Beside people who are sure (company.hpp): of 190 frames of groups ten people and one thing lie
/// between this and 0.5, five and one between 0.2 and this.
constexpr Real kLeastAccompaniedConfidence = 0.35;
/// The same is asked of who shows a face as plainly as real people near the camera do [log odds]:
/// what they hold before them hides the trunk. Of 200 things that were taken for heads in simulated
/// rooms none shows more than 0.4; of one real man with a board, in 162 pairs, 13 looks more are
/// told.
constexpr float kPlainFaceLogOdds = 4.0F;
/// Before a scanner, where the surface alone speaks, a body must be surer, also beside others: of
/// 489 people of 150 simulated streets 427 are told, of 360 streets without any no thing; with 0.5
/// 432 and three. Of a real street (154 scans of 64 rings) 105 of 143 people within 9 m are, and no
/// thing (tests/accuracy/README.md, "A network of depths for scans").
constexpr Real kLeastScannedPersonConfidence = 0.85;
/// A body whose head is left out though it would be within the image must be surer: a piece of wall
/// between somebody's head and raised hand was told with 0.78.
constexpr Real kLeastHeadlessConfidence = 0.9;
/// A body of whose joints fewer than two are likelier where they are than elsewhere tells nothing
/// of anybody. Of 1922 people told (20 simulated sets) none is such a body; a corner of a picture
/// on the wall behind a raised hand was (its head 0.17, its neck 0.75, told with 0.58).
constexpr float kLikelyJointConfidence = 0.5F;
constexpr std::ptrdiff_t kLeastLikelyJoints = 2;
/// Before a camera, nearer than this [m], legs are out of sight: of 340 simulated frames of people
/// there ten more are told than at 0.75, of 380 rooms no thing more.
constexpr Real kNearM = 1.5, kLeastNearPersonConfidence = 0.5;
/// The trees of the confidence were trained on nobody where the depth's noise is larger [m]: there
/// a body must be surer (a thing 6.7 m from a VGA pair was told with 0.77).
constexpr Real kMostTrainedNoiseM = 0.05, kLeastNoisyPersonConfidence = 0.9;

bool of_scanner(const Observation& observation) {
  return !observation.has_colors && !observation.noise.grows_with_distance();
}

bool is_noisy(const FittedBody& fitted) {
  const auto distance_m = static_cast<float>(fitted.body.points[kHead].z());
  return fitted.observation.noise.sigma_m(distance_m) > kMostTrainedNoiseM;
}

bool shows_face(const FittedBody& fitted) {
  return fitted.observation.face.facing_log_odds > kPlainFaceLogOdds;
}

bool has_head_in_image(const FittedBody& fitted) {
  const auto [u, v] = fitted.observation.pixel_of(fitted.body.points[kHead]);
  return fitted.observation.in_sensor_image(u, v);
}

bool has_likely_joints(const BodyPose& pose) {
  const auto is_likely = [](const JointEstimate& joint) {
    return joint.confidence >= kLikelyJointConfidence;
  };
  return std::count_if(pose.joints.begin(), pose.joints.end(), is_likely) >= kLeastLikelyJoints;
}

/// Of somebody who is alone.
Real least_confidence(const FittedBody& fitted) {
  if (is_noisy(fitted)) return kLeastNoisyPersonConfidence;
  if (of_scanner(fitted.observation)) return kLeastScannedPersonConfidence;
  const bool near = fitted.body.points[kHead].z() < kNearM;
  return near ? kLeastNearPersonConfidence : kLeastPersonConfidence;
}

Real least_accompanied_confidence(const FittedBody& fitted) {
  if (is_noisy(fitted)) return kLeastNoisyPersonConfidence;
  return of_scanner(fitted.observation) ? kLeastScannedPersonConfidence
                                        : kLeastAccompaniedConfidence;
}

/// How sure it is that an arm is the one that points, when another one that is straighter and more
/// raised may be: at most one of the two does.
Real confidence_beside(Real confidence, Real other) {
  return confidence * (1.0 - other) / (1.0 - confidence * other);
}

/// The arms that point, surely, of those that may by the rule, the likelier by the rule first.
std::vector<Pointing> sure_directions(const FittedBody& fitted, std::vector<Pointing> arms) {
  std::vector<Pointing> sure;
  std::optional<Real> unsure_before;
  const Real facing = facing_confidence(fitted.evidence);
  for (Pointing& pointing : arms) {
    const int side = static_cast<int>(pointing.side);
    Real confidence = direction_confidence(fitted.body, side, fitted.evidence);
    if (confidence < kLeastArmConfidence) continue;
    if (unsure_before) confidence = confidence_beside(confidence, *unsure_before);
    if (confidence < (unsure_before ? kLeastOtherArmConfidence : kLeastPointingConfidence)) {
      unsure_before = confidence;
      continue;
    }
    // Of a body taken back to front the other arm points.
    confidence *= facing;
    if (confidence < kLeastPointingConfidence) continue;
    pointing.confidence = static_cast<float>(confidence);
    pointing.sigma_rad = static_cast<float>(spread_scale() * fitted.evidence.arms[side].sigma_rad);
    sure.push_back(pointing);
  }
  return sure;
}

}  // namespace

std::optional<PersonCandidate> assess(const FittedBody& fitted) {
  const BodyState& body = fitted.body;
  const Evidence& evidence = fitted.evidence;
  PersonCandidate candidate;
  BodyPose& pose = candidate.pose;
  for (int i = 0; i < kJointCount; ++i) {
    JointEstimate& joint = pose.joints[i];
    joint.position_m = body.points[i].cast<float>();
    joint.confidence = static_cast<float>(joint_confidence(evidence, i));
    joint.sigma_m = static_cast<float>(spread_scale() * evidence.sigma_m[i]);
    joint.valid = joint.confidence >= kLeastJointConfidence;
  }
  const Eigen::Vector3f down = (-fitted.observation.up).cast<float>();
  pose.pointing = sure_directions(fitted, find_pointing(pose, down, kPointingRule));
  pose.scale = static_cast<float>(body.stature_m() / kReferenceStatureM);
  pose.confidence = static_cast<float>(person_confidence(fitted));
  if (pose.confidence < least_accompanied_confidence(fitted)) return std::nullopt;
  if (!has_likely_joints(pose)) return std::nullopt;
  candidate.needs_company = pose.confidence < least_confidence(fitted) && !shows_face(fitted);
  // What is seen between somebody's legs or beside an arm looks like people without a head behind.
  const bool is_unsure = pose.confidence < kLeastHeadlessConfidence && has_head_in_image(fitted);
  if (!pose[Joint::kHead].valid && (candidate.needs_company || is_unsure)) return std::nullopt;
  return candidate;
}

}  // namespace limbcast::pose_fitter::refined
