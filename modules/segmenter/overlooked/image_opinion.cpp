#include "modules/segmenter/overlooked/image_opinion.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <map>
#include <utility>

namespace limbcast::segmenter {
namespace {

/// The second network looks only where the first does: else it need not be loaded.
PoseNetworkParams second_of(const Params& params) {
  PoseNetworkParams second = params.second_pose_network;
  second.enabled = second.enabled && params.pose_network.enabled;
  return second;
}

/// Where the network marks a head whose depth is known, in the camera's optical frame [m].
Eigen::Vector3f marked_head(const ImagePose& pose, const PinholeCamera& camera, float depth_m) {
  const auto seen = std::find_if(pose.joints.begin(), pose.joints.end(),
                                 [](const ImageJoint& j) { return j.joint == Joint::kHead; });
  return camera.back_project(seen->px.x(), seen->px.y(), depth_m);
}

}  // namespace

ImageOpinion::ImageOpinion(const Params& params)
    : params_(params),
      network_(params.pose_network),
      second_network_(second_of(params), PictureNetworkKind::kMoveNet) {}

HeadOpinion ImageOpinion::head_opinion(const Scene& scene) const {
  if (!params_.pose_network.enabled || !has_image(scene.cloud)) return nullptr;
  // Asked again when all heads grow anew beside one that was found later.
  using Pixel = std::pair<int, int>;
  return [&, known = std::map<Pixel, std::optional<float>>()](const HeadCandidate& head) mutable {
    const auto [told, is_new] = known.try_emplace({head.u, head.v});
    if (is_new) told->second = head_odds(scene, head);
    return told->second;
  };
}

BodyOpinion ImageOpinion::body_opinion(const Scene& scene, const FoundPeople& people) const {
  if (!params_.pose_network.enabled || !has_image(scene.cloud)) return nullptr;
  // Most surfaces that are asked about change nobody's labels: those of the cloud are kept.
  using Labels = std::vector<std::int16_t>;
  return [&, known = Labels(), labels = Labels()](const HeadlessSurface& surface) mutable {
    if (known != people.labels) {
      known = people.labels;
      labels = labels_of_cloud(scene, known, params_.joint);
    }
    return see_body(scene, labels, surface.head);
  };
}

std::vector<ImagePose> ImageOpinion::see(const Scene& scene, const LabelledPerson& person) const {
  const Eigen::Vector3f down = scene.lattice.frame.down();
  std::optional<ImagePose> first, second;
  tbb::parallel_invoke([&] { first = network_.look(scene.cloud, person, down); },
                       [&] { second = second_network_.look(scene.cloud, person, down); });
  std::vector<ImagePose> poses;
  if (first) poses.push_back(std::move(*first));
  // Alone the second would be taken for the first.
  if (first && second) poses.push_back(std::move(*second));
  return poses;
}

std::optional<float> ImageOpinion::head_odds(const Scene& scene, const HeadCandidate& head) const {
  const LevelFrame& frame = scene.lattice.frame;
  const Eigen::Vector3f head_m = frame.to_sensor(head.center_m);
  const std::vector<std::int16_t> nobodys(scene.cloud.points_m.size(), kNobody);
  const auto pose = network_.look(scene.cloud, {nobodys, kNobody, head_m}, frame.down());
  if (!pose) return std::nullopt;
  const float distance_m = (marked_head(*pose, *scene.cloud.camera, head_m.z()) - head_m).norm();
  const PoseNetworkParams& params = params_.pose_network;
  return params.base_odds + params.depth_odds * head.odds +
         params.score_odds * std::clamp(log_odds(pose->person_score), -params.max_score_odds,
                                        params.max_score_odds) +
         params.distance_odds_per_m * std::min(distance_m, params.max_distance_m);
}

std::optional<SeenBody> ImageOpinion::see_body(const Scene& scene,
                                               const std::vector<std::int16_t>& labels,
                                               const HeadCandidate& head) const {
  const LevelFrame& frame = scene.lattice.frame;
  const Eigen::Vector3f head_m = frame.to_sensor(head.center_m);
  // The body's own points are nobody's: only those of others are painted over.
  const auto pose = network_.look(scene.cloud, {labels, kNobody, head_m}, frame.down());
  if (!pose) return std::nullopt;
  SeenBody seen;
  seen.head_m = frame.to_level(marked_head(*pose, *scene.cloud.camera, head_m.z()));
  seen.score_odds = log_odds(pose->person_score);
  for (const ImageJoint& joint : pose->joints) seen.visible_joints += joint.visibility;
  return seen;
}

}  // namespace limbcast::segmenter
