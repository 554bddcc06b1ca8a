#include "modules/pose_fitter/refined/refined_fitter.hpp"

#include <algorithm>
#include <cmath>

#include "modules/pose_fitter/refined/assessment.hpp"
#include "modules/pose_fitter/refined/observation.hpp"
#include "modules/pose_fitter/refined/pose_search.hpp"

namespace limbcast::pose_fitter {
namespace {

void rotate(const Eigen::Matrix3f& rotation, BodyPose& pose) {
  for (JointEstimate& joint : pose.joints) joint.position_m = rotation * joint.position_m;
  for (Pointing& pointing : pose.pointing) {
    pointing.direction = rotation * pointing.direction;
    pointing.forearm = rotation * pointing.forearm;
    pointing.head_hand = rotation * pointing.head_hand;
  }
}

/// Logarithm of the odds that the candidate began at a head; one begun at skin alone was not
/// judged.
double head_odds(const Segment& segment) {
  constexpr double kUnjudged = 3.0, kMost = 5.0;  // the median of people; more tells nothing new
  if (segment.seed_kind == SeedKind::kSkin) return kUnjudged;
  const double score = segment.seed_score;
  return std::clamp(std::log(score / std::max(1e-6, 1.0 - score)), -kMost, kMost);
}

}  // namespace

std::optional<BodyPose> RefinedFitter::fit(const Segment& segment, const Stamp& stamp) const {
  const std::optional<refined::Observation> observation = refined::observe(segment, stamp, params_);
  if (!observation) return std::nullopt;
  refined::PoseSearch search(*observation, params_);
  const std::vector<refined::PoseCandidate> candidates = search.run();
  refined::Evidence evidence = refined::gather_evidence(candidates, search);
  evidence.head_odds = head_odds(segment);
  std::optional<BodyPose> pose = refined::assess(candidates.front().body, evidence, *observation);
  if (!pose) return std::nullopt;
  rotate(observation->frame_from_image, *pose);
  pose->id = segment.id;
  pose->error =
      static_cast<float>(candidates.front().cost / static_cast<double>(observation->fine.size()));
  return pose;
}

}  // namespace limbcast::pose_fitter
