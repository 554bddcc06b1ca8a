#include "modules/segmenter/segmenter.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "modules/segmenter/body_cut.hpp"
#include "modules/segmenter/furniture.hpp"
#include "modules/segmenter/ground.hpp"
#include "modules/segmenter/head_shape.hpp"
#include "modules/segmenter/hidden_heads.hpp"
#include "modules/segmenter/joint_growing.hpp"
#include "modules/segmenter/panorama.hpp"
#include "modules/segmenter/paper_search.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/range_image.hpp"
#include "modules/segmenter/skin_seeds.hpp"

namespace limbcast::segmenter {
namespace {

/// Focal length of the thinned lattice [px]: a head at 4 m is then 12 pixels wide.
constexpr double kLatticeFocal_px = 260.0;

/// A skin part whose middle is this near to a head's is its face.
constexpr float kSameSeed_m = 0.15F;

Segment make_segment(const HeadCandidate& head, const LevelFrame& frame, float odds) {
  Segment segment;
  segment.seed_m = frame.to_sensor(head.surface_m);
  segment.seed_kind = head.kind;
  segment.seed_score = probability(odds);
  return segment;
}

/// The head whose centre is told, at the pixel of the lattice nearest to it; nothing where none
/// lies near.
std::optional<HeadCandidate> head_at(const Lattice& lattice, const Eigen::Vector3f& center_m) {
  constexpr float kNear_m = 0.15F;
  float nearest_m = kNear_m * kNear_m;
  std::optional<HeadCandidate> head;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    if (lattice.depth_m[i] <= 0.0F) continue;
    const float distance_m = (lattice.level_m[i] - center_m).squaredNorm();
    if (distance_m >= nearest_m) continue;
    nearest_m = distance_m;
    head.emplace();
    head->u = static_cast<int>(i) % lattice.width;
    head->v = static_cast<int>(i) / lattice.width;
    head->surface_m = lattice.level_m[i];
    head->center_m = center_m;
  }
  return head;
}

/// Centre of the head whose surface is seen at `seed_m`.
Eigen::Vector3f behind_surface(const Eigen::Vector3f& seed_m) {
  constexpr float kHeadDepth_m = 0.09F;
  return seed_m + kHeadDepth_m * seed_m.normalized();
}

Eigen::Vector3f down_of(const LevelFrame& frame) {
  return -frame.level_from_sensor.row(2).transpose();
}

/// Where the network marks a head whose depth is known, in the camera's optical frame [m].
Eigen::Vector3f marked_head(const ImagePose& pose, const PinholeCamera& camera, float depth_m) {
  const auto seen = std::find_if(pose.joints.begin(), pose.joints.end(),
                                 [](const ImageJoint& j) { return j.joint == Joint::kHead; });
  return camera.back_project(seen->px.x(), seen->px.y(), depth_m);
}

/// The second network looks only where the first does: else it need not be loaded.
PoseNetworkParams second_of(const Params& params) {
  PoseNetworkParams second = params.second_pose_network;
  second.enabled = second.enabled && params.pose_network.enabled;
  return second;
}

bool has_image(const Cloud& cloud) { return cloud.organized() && !cloud.colors.empty(); }

/// The camera's own image; of a scan one that shows the place.
RangeImage view_towards(const Cloud& cloud, const Eigen::Vector3f& place_m,
                        const Eigen::Vector3f& down) {
  RangeImage view;
  if (cloud.organized()) {
    view.camera = *cloud.camera;
  } else {
    view.frame_from_image = upright_view(place_m, down);
    view.camera.fx = view.camera.fy = 1.0;
  }
  return view;
}

void reject(const Rejection& rejection, Segment& segment) {
  segment.rejected_by = rejection.filter;
  segment.filter_figure = rejection.figure;
  segment.filter_limit = rejection.limit;
}

}  // namespace

Segmenter::Segmenter(const Params& params)
    : params_(params),
      faces_(params.faces),
      pose_network_(params.pose_network),
      second_pose_network_(second_of(params), PictureNetworkKind::kMoveNet) {}

Lattice make_lattice(const Cloud& cloud, const LevelFrame& frame, int& step) {
  step = std::max(1, static_cast<int>(std::lround(cloud.camera->fx / kLatticeFocal_px)));
  return thin(cloud, frame, step);
}

Segments Segmenter::segment(const Cloud& cloud) const {
  Segments result;
  result.stamp = cloud.stamp;
  const Scene scene = look_at(cloud);
  const std::vector<HeadCandidate> seeds = find_seeds(scene);
  const std::vector<std::int16_t> labels = params_.growing == Growing::kPaper
                                               ? grow_as_paper(scene, seeds, result)
                                               : grow_refined(scene, seeds, result);
  fill_segments(scene, labels, result);
  return result;
}

Segments Segmenter::cut_out_people(const Cloud& cloud,
                                   const std::vector<Eigen::Vector3f>& heads_m) const {
  Segments result;
  result.stamp = cloud.stamp;
  const Scene scene = look_at(cloud);
  std::vector<HeadCandidate> heads;
  for (const Eigen::Vector3f& head_m : heads_m) {
    const auto head = head_at(scene.lattice, scene.lattice.frame.to_level(head_m));
    if (!head) continue;
    heads.push_back(*head);
    result.segments.push_back(make_segment(*head, scene.lattice.frame, 0.0F));
  }
  JointGrowth growth(scene.lattice, heads, params_.joint, params_.reach);
  leave_furniture(scene.lattice, params_.furniture, growth);
  const std::vector<std::uint32_t> unsure =
      cut_to_bodies(scene.lattice, bodies_, params_.body_cut, growth);
  std::vector<std::int16_t> labels = growth.labels();
  for (const std::uint32_t i : unsure) labels[i] = kUnsure;
  fill_segments(scene, labels_of_cloud(scene, labels), result);
  return result;
}

Segmenter::Scene Segmenter::look_at(const Cloud& cloud) const {
  const LevelFrame frame =
      make_level_frame(cloud.stamp.gravity, find_ground(cloud, params_.ground));
  Scene scene{cloud, {}};
  scene.lattice = cloud.organized() ? make_lattice(cloud, frame, scene.step)
                                    : render_panorama(cloud, frame, params_.panorama);
  return scene;
}

std::vector<HeadCandidate> Segmenter::find_seeds(const Scene& scene) const {
  const bool skin = params_.seeds != SeedSource::kShape;
  const bool shape = params_.seeds != SeedSource::kSkin;
  std::vector<HeadCandidate> seeds;
  if (shape) seeds = find_heads(scene.lattice, params_.head);
  const std::size_t heads = seeds.size();
  if (!skin) return seeds;
  for (const HeadCandidate& part :
       find_skin_parts(scene.cloud, scene.lattice, skin_, params_.skin)) {
    const auto same =
        std::find_if(seeds.begin(), seeds.begin() + static_cast<std::ptrdiff_t>(heads),
                     [&](const HeadCandidate& head) {
                       return (head.center_m - part.center_m).norm() < kSameSeed_m;
                     });
    if (same == seeds.begin() + static_cast<std::ptrdiff_t>(heads)) {
      // A skin-coloured part without the shape of a head is furniture far more often than a head
      // (README): `auto` takes it only for the paper's growing.
      if (params_.seeds != SeedSource::kAuto || params_.growing == Growing::kPaper)
        seeds.push_back(part);
    } else
      same->kind = SeedKind::kBoth;
  }
  return seeds;
}

std::vector<std::int16_t> Segmenter::grow_refined(const Scene& scene,
                                                  const std::vector<HeadCandidate>& seeds,
                                                  Segments& result) const {
  const LevelFrame& frame = scene.lattice.frame;
  const HeadOpinion opinion = [&](const HeadCandidate& head) {
    return image_head_odds(scene, head);
  };
  FoundPeople people = find_people(scene.lattice, seeds, classifier_, bodies_, params_, opinion);
  const SurfaceParams& surface = params_.hidden_heads.surface;
  Surfaces surfaces = find_surfaces(scene.lattice, surface, &people.labels);
  const std::vector<HeadCandidate> whole = find_whole_people(scene, surfaces);
  if (!whole.empty()) {
    std::vector<HeadCandidate> all = seeds;
    all.insert(all.end(), whole.begin(), whole.end());
    people = find_people(scene.lattice, std::move(all), classifier_, bodies_, params_, opinion);
    surfaces = find_surfaces(scene.lattice, surface, &people.labels);
  }
  if (scene.cloud.organized())
    add_headless_people(scene.lattice, surfaces, surfaces_, params_.hidden_heads, people,
                        body_opinion(scene, people));
  for (std::size_t k = 0; k < people.heads.size(); ++k)
    result.segments.push_back(make_segment(people.heads[k], frame, people.person_odds[k]));
  for (const RejectedHead& rejected : people.rejected) {
    result.segments.push_back(make_segment(rejected.head, frame, rejected.head.odds));
    reject(rejected.rejection, result.segments.back());
  }
  return labels_of_cloud(scene, people.labels);
}

BodyOpinion Segmenter::body_opinion(const Scene& scene, const FoundPeople& people) const {
  if (!params_.pose_network.enabled || !has_image(scene.cloud)) return nullptr;
  return [&](const HeadlessSurface& surface) -> std::optional<SeenBody> {
    const LevelFrame& frame = scene.lattice.frame;
    const auto label = static_cast<std::int16_t>(people.heads.size());
    std::vector<std::int16_t> labels = people.labels;
    for (const std::uint32_t i : surface.points) labels[i] = label;
    labels = labels_of_cloud(scene, labels);
    const Eigen::Vector3f head_m = frame.to_sensor(surface.head.center_m);
    const auto pose = pose_network_.look(scene.cloud, {labels, label, head_m}, down_of(frame));
    if (!pose) return std::nullopt;
    SeenBody seen;
    seen.head_m = frame.to_level(marked_head(*pose, *scene.cloud.camera, head_m.z()));
    seen.score_odds = log_odds(pose->person_score);
    for (const ImageJoint& joint : pose->joints) seen.visible_joints += joint.visibility;
    return seen;
  };
}

std::optional<float> Segmenter::image_head_odds(const Scene& scene,
                                                const HeadCandidate& head) const {
  const LevelFrame& frame = scene.lattice.frame;
  const Eigen::Vector3f head_m = frame.to_sensor(head.center_m);
  const std::vector<std::int16_t> nobodys(scene.cloud.points_m.size(), kNobody);
  const auto pose = pose_network_.look(scene.cloud, {nobodys, kNobody, head_m}, down_of(frame));
  if (!pose) return std::nullopt;
  const float distance_m = (marked_head(*pose, *scene.cloud.camera, head_m.z()) - head_m).norm();
  const PoseNetworkParams& params = params_.pose_network;
  return params.base_odds + params.depth_odds * head.odds +
         params.score_odds * std::clamp(log_odds(pose->person_score), -params.max_score_odds,
                                        params.max_score_odds) +
         params.distance_odds_per_m * std::min(distance_m, params.max_distance_m);
}

std::vector<HeadCandidate> Segmenter::find_whole_people(const Scene& scene,
                                                        const Surfaces& surfaces) const {
  std::vector<HeadCandidate> people;
  const Eigen::Vector3f down = down_of(scene.lattice.frame);
  for (auto& [head, points] : find_whole_bodies(scene.lattice, surfaces, params_.whole_bodies)) {
    // Depths alone tell most furniture before a camera, in less time than the network.
    if (scene.cloud.organized() &&
        surfaces_.mean_odds(scene.lattice, points) < params_.whole_bodies.min_body_odds)
      continue;
    constexpr std::int16_t kThis = 0;
    std::vector<std::int16_t> labels(scene.lattice.size(), kNobody);
    for (const std::uint32_t i : points) labels[i] = kThis;
    labels = labels_of_cloud(scene, labels);
    const Eigen::Vector3f head_m = scene.lattice.frame.to_sensor(head.center_m);
    const RangeImage view = view_towards(scene.cloud, head_m, down);
    const LabelledPerson body{labels, kThis, head_m};
    const auto pose = has_image(scene.cloud)
                          ? pose_network_.look(scene.cloud, body, down)
                          : pose_network_.look_at_surface(scene.cloud, body, down, view);
    if (!pose) continue;
    const float depth_m = view.frame_from_image.col(2).dot(head_m);
    const Eigen::Vector3f marked_m =
        view.frame_from_image * marked_head(*pose, view.camera, depth_m);
    if (pose->person_score < params_.whole_bodies.min_score ||
        (marked_m - head_m).norm() > params_.whole_bodies.max_head_distance_m)
      continue;
    // The top may be hidden; the network sees where the head is all the same.
    head.center_m = scene.lattice.frame.to_level(marked_m);
    head.surface_m = head_surface(scene.lattice, head.center_m);
    head.odds = params_.whole_bodies.head_odds;
    people.push_back(head);
  }
  return people;
}

std::vector<std::int16_t> Segmenter::labels_of_cloud(
    const Scene& scene, const std::vector<std::int16_t>& labels) const {
  return scene.cloud.organized()
             ? thicken(scene.cloud, scene.lattice, scene.step, labels, params_.joint)
             : labels_of_points(scene.cloud, scene.lattice, labels, params_.joint);
}

std::vector<std::int16_t> Segmenter::grow_as_paper(const Scene& scene,
                                                   const std::vector<HeadCandidate>& seeds,
                                                   Segments& result) const {
  const Cloud& cloud = scene.cloud;
  const bool by_lattice = cloud.organized() && params_.search != SearchStructure::kKdTree;
  const auto search = by_lattice ? make_lattice_search(cloud) : make_kd_tree_search(cloud);
  std::vector<std::int16_t> labels(cloud.points_m.size(), kNobody);
  for (const PaperCluster& cluster :
       find_people_as_paper(cloud, scene.lattice, seeds, *search, params_)) {
    result.segments.push_back(make_segment(cluster.seed, scene.lattice.frame, 0.0F));
    if (cluster.rejection) {
      reject(*cluster.rejection, result.segments.back());
      continue;
    }
    // Where two people's clusters overlap, the first one's points are its own: a point is one
    // person's.
    const auto label = static_cast<std::int16_t>(result.segments.size() - 1);
    for (const std::uint32_t i : cluster.points) {
      if (labels[i] == kNobody) labels[i] = label;
    }
  }
  return labels;
}

void Segmenter::fill_segments(const Scene& scene, const std::vector<std::int16_t>& labels,
                              Segments& result) const {
  const RangeImageSource source{scene.cloud, labels, skin_, params_.skin.min_log_ratio,
                                params_.range_image_margin_m};
  const Eigen::Vector3f down = down_of(scene.lattice.frame);
  for (std::size_t k = 0; k < result.segments.size(); ++k) {
    Segment& segment = result.segments[k];
    segment.id = static_cast<std::int32_t>(k);
    if (!segment.valid()) continue;
    const auto label = static_cast<std::int16_t>(k);
    const Eigen::Vector3f head_m = behind_surface(segment.seed_m);
    // A head that is out of sight shows no face: that tells nothing.
    if (segment.seed_kind != SeedKind::kBody)
      segment.face = faces_.look(scene.cloud, head_m, scene.lattice.up);
    if (scene.cloud.organized())
      fill_from_camera(source, label, segment);
    else
      fill_from_scan(source, label, down, params_.scan_range_image.focal_px,
                     params_.scan_range_image.gap_px, segment);
    if (segment.range_image)
      segment.image_poses = see(scene.cloud, {labels, label, head_m}, down, *segment.range_image);
  }
}

std::vector<ImagePose> Segmenter::see(const Cloud& cloud, const LabelledPerson& person,
                                      const Eigen::Vector3f& down, const RangeImage& view) const {
  std::vector<ImagePose> poses;
  const auto add = [&](std::optional<ImagePose> pose) {
    if (pose) poses.push_back(std::move(*pose));
  };
  if (!has_image(cloud)) {
    // The second network takes the stripes of few rings for limbs.
    add(pose_network_.look_at_surface(cloud, person, down, view));
    return poses;
  }
  add(pose_network_.look(cloud, person, down));
  // Alone it would be taken for the first.
  if (!poses.empty()) add(second_pose_network_.look(cloud, person, down));
  return poses;
}

Segments segment(const Cloud& cloud, const Params& params) {
  return Segmenter(params).segment(cloud);
}

}  // namespace limbcast::segmenter
