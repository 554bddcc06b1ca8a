#include "modules/pose_fitter/refined/refined_fitter.hpp"

#include "modules/pose_fitter/refined/confidence/assessment.hpp"
#include "modules/pose_fitter/refined/fitted_body.hpp"
#include "modules/pose_fitter/refined/links_and_angles.hpp"

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

}  // namespace

RefinedFitter::RefinedFitter(const RefinedParams& params)
    : params_(params), model_(load_human_model()) {}

std::optional<PersonCandidate> RefinedFitter::fit(const Segment& segment,
                                                  const Stamp& stamp) const {
  const std::optional<refined::FittedBody> fitted = refined::fit_body(segment, stamp, params_);
  if (!fitted) return std::nullopt;
  const refined::Observation& observation = fitted->observation;
  std::optional<PersonCandidate> candidate = refined::assess(*fitted);
  if (!candidate) return std::nullopt;
  BodyPose& pose = candidate->pose;
  rotate(observation.frame_from_image, pose);
  refined::add_links_and_angles(model_,
                                observation.frame_from_image * fitted->body.front().cast<float>(),
                                stamp.gravity.down, pose);
  pose.id = segment.id;
  pose.error = static_cast<float>(fitted->cost / static_cast<double>(observation.fine.size()));
  return candidate;
}

}  // namespace limbcast::pose_fitter
