#include "modules/segmenter/segmenter.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "modules/segmenter/bodies/body_cut.hpp"
#include "modules/segmenter/bodies/floating_arms.hpp"
#include "modules/segmenter/bodies/furniture.hpp"
#include "modules/segmenter/bodies/lost_arms.hpp"
#include "modules/segmenter/growing/joint_growing.hpp"
#include "modules/segmenter/growing/paper_search.hpp"
#include "modules/segmenter/overlooked/hidden_heads.hpp"
#include "modules/segmenter/overlooked/overlooked.hpp"
#include "modules/segmenter/overlooked/overlooked_bodies.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/range_image.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"
#include "modules/segmenter/seeds/seed_place.hpp"
#include "modules/segmenter/seeds/skin_seeds.hpp"

namespace limbcast::segmenter {
namespace {

/// A skin part whose middle is this near to a head's is its face.
constexpr float kSameSeed_m = 0.15F;

Segment make_segment(const HeadCandidate& head, const LevelFrame& frame, float odds) {
  Segment segment;
  segment.seed_m = frame.to_sensor(head.surface_m);
  segment.seed_kind = head.kind;
  segment.seed_score = probability(odds);
  return segment;
}

/// What the network of depths sees, among what those of colours see.
void add_pose(const std::optional<PoseInDepths>& seen, Segment& segment) {
  if (!seen || !segment.range_image) return;
  auto pose = in_pixels(*seen, *segment.range_image);
  if (!pose) return;
  segment.image_poses.resize(kImageNetworkCount);
  segment.image_poses[static_cast<std::size_t>(ImageNetwork::kDepthPose)] = std::move(*pose);
}

void reject(const Rejection& rejection, Segment& segment) {
  segment.rejected_by = rejection.filter;
  segment.filter_figure = rejection.figure;
  segment.filter_limit = rejection.limit;
}

}  // namespace

Segmenter::Segmenter(const Params& params)
    : params_(params), faces_(params.faces), image_(params), depth_pose_(params.depth_pose) {}

Segments Segmenter::segment(const Cloud& cloud, DepthPictures* pictures) const {
  Segments result;
  result.stamp = cloud.stamp;
  const Scene scene = look_at(cloud, params_);
  const std::vector<HeadCandidate> seeds = find_seeds(scene);
  const std::vector<std::int16_t> labels = params_.growing == Growing::kPaper
                                               ? grow_as_paper(scene, seeds, result)
                                               : grow_refined(scene, seeds, result);
  DepthPictures drawn = fill_segments(scene, labels, Heads::kFound, result);
  if (pictures != nullptr) *pictures = std::move(drawn);
  return result;
}

Segments Segmenter::cut_out_people(const Cloud& cloud,
                                   const std::vector<Eigen::Vector3f>& heads_m) const {
  Segments result;
  result.stamp = cloud.stamp;
  const Scene scene = look_at(cloud, params_);
  std::vector<HeadCandidate> heads;
  for (const Eigen::Vector3f& head_m : heads_m) {
    const auto head = head_near(scene.lattice, scene.lattice.frame.to_level(head_m));
    if (!head) continue;
    heads.push_back(*head);
    result.segments.push_back(make_segment(*head, scene.lattice.frame, 0.0F));
  }
  fill_segments(scene, grow_from(scene, std::move(heads)), Heads::kTold, result);
  return result;
}

std::vector<std::int16_t> Segmenter::grow_from(const Scene& scene, std::vector<HeadCandidate> heads,
                                               const std::vector<std::int16_t>* taken) const {
  JointGrowth growth(scene.lattice, std::move(heads), params_.joint, params_.reach, taken);
  leave_furniture(scene.lattice, params_.furniture, growth);
  const std::vector<std::uint32_t> unsure =
      cut_to_bodies(scene.lattice, bodies_, params_.body_cut, growth);
  std::vector<std::int16_t> labels = growth.labels();
  for (const std::uint32_t i : unsure) labels[i] = kUnsure;
  return labels_of_cloud(scene, labels, params_.joint);
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
                                                  std::vector<HeadCandidate> seeds,
                                                  Segments& result) const {
  const LevelFrame& frame = scene.lattice.frame;
  const HeadOpinion opinion = image_.head_opinion(scene);
  FoundPeople people;
  Surfaces surfaces;
  const auto find = [&] {
    people = find_people(scene.lattice, seeds, classifier_, bodies_, params_, opinion);
    surfaces = find_surfaces(scene.lattice, params_.hidden_heads.surface, &people.labels);
  };
  const auto find_with = [&](const std::vector<HeadCandidate>& more) {
    if (more.empty()) return;
    // In place of the same heads as they were refused.
    const auto is_found = [&](const HeadCandidate& seed) {
      return std::any_of(more.begin(), more.end(), [&](const HeadCandidate& head) {
        return head.u == seed.u && head.v == seed.v;
      });
    };
    seeds.erase(std::remove_if(seeds.begin(), seeds.end(), is_found), seeds.end());
    seeds.insert(seeds.end(), more.begin(), more.end());
    find();
  };
  find();
  find_with(find_overlooked_people(scene, people));
  const auto add_headless = [&](FoundPeople& found) {
    if (scene.cloud.organized())
      add_headless_people(scene.lattice, surfaces, surfaces_, params_.hidden_heads, found,
                          image_.body_opinion(scene, found));
  };
  FoundPeople with_headless = people;
  add_headless(with_headless);
  // What is left may be somebody's whose head is in sight: then all grow anew.
  const OverlookedBodies bodies =
      find_overlooked_bodies(scene, surfaces, with_headless, {params_, surfaces_, depth_pose_});
  if (bodies.heads.empty()) {
    people = std::move(with_headless);
  } else {
    find_with(bodies.heads);
    add_headless(people);
  }
  const std::size_t first = people.heads.size();
  for (const HeadlessSurface& body : bodies.headless) {
    if (people.labels[body.points.front()] == kNobody)
      add_headless_person(body, params_.overlooked.head_odds, first, params_.hidden_heads, people);
  }
  add_floating_arms(
      scene.lattice,
      has_image(scene.cloud) ? params_.floating_arms_beside_image : params_.floating_arms, people);
  for (std::size_t k = 0; k < people.heads.size(); ++k)
    result.segments.push_back(make_segment(people.heads[k], frame, people.person_odds[k]));
  for (const RejectedHead& rejected : people.rejected) {
    result.segments.push_back(make_segment(rejected.head, frame, rejected.head.odds));
    reject(rejected.rejection, result.segments.back());
  }
  return labels_of_cloud(scene, people.labels, params_.joint);
}

std::vector<HeadCandidate> Segmenter::find_overlooked_people(const Scene& scene,
                                                             const FoundPeople& people) const {
  if (!params_.depth_pose.enabled) return {};
  const OverlookedParams& params = params_.overlooked;
  std::vector<HeadCandidate> seen;
  if (auto refused = find_overlooked(scene.lattice, people, params); !refused.empty()) {
    const std::vector<std::int16_t> labels = grow_from(scene, refused, &people.labels);
    seen = heads_of_people(scene,
                           {std::move(refused),
                            labels,
                            0,
                            {params.min_person_odds},
                            BodyLimits{params.min_likely_person_odds, params.max_likely_error_m},
                            true},
                           params_, depth_pose_);
  }
  if (auto merged = find_merged(scene.lattice, people, params); !merged.empty()) {
    // They and the people whom they were taken for share the points anew.
    std::vector<HeadCandidate> all = people.heads;
    all.insert(all.end(), merged.begin(), merged.end());
    const std::vector<std::int16_t> labels = grow_from(scene, std::move(all));
    merged = heads_of_people(scene,
                             {std::move(merged),
                              labels,
                              static_cast<std::int16_t>(people.heads.size()),
                              {params.min_merged_person_odds, params.max_merged_error_m}},
                             params_, depth_pose_);
    for (HeadCandidate& head : merged) head.stands_beside = true;
    seen.insert(seen.end(), merged.begin(), merged.end());
  }
  return seen;
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

void Segmenter::join_arms(const Scene& scene, std::vector<std::int16_t>& labels,
                          Segments& result) const {
  const auto look = [&](const std::vector<std::int16_t>& told,
                        std::int16_t person) -> std::optional<ImagePose> {
    const Segment& segment = result.segments[static_cast<std::size_t>(person)];
    auto poses = image_.see(scene, {told, person, behind_surface(segment.seed_m)});
    if (poses.empty()) return std::nullopt;
    return std::move(poses.back());
  };
  join_arms_taken_for_heads(scene, look, params_.lost_arms, result.segments, labels);
}

void Segmenter::see_people(const Scene& scene, const std::vector<std::int16_t>& labels,
                           Segments& result) const {
  for (std::size_t k = 0; k < result.segments.size(); ++k) {
    Segment& segment = result.segments[k];
    if (!segment.valid()) continue;
    const Eigen::Vector3f head_m = behind_surface(segment.seed_m);
    const LabelledPerson person{labels, static_cast<std::int16_t>(k), head_m};
    tbb::parallel_invoke([&] { segment.image_poses = image_.see(scene, person); },
                         [&] {
                           // A head that is out of sight shows no face: that tells nothing.
                           if (segment.seed_kind != SeedKind::kBody)
                             segment.face = faces_.look(scene.cloud, head_m, scene.lattice.up);
                         });
  }
}

DepthPictures Segmenter::draw_people(const Scene& scene, const std::vector<std::int16_t>& labels,
                                     const std::vector<Segment>& segments) const {
  DepthPictures pictures(segments.size());
  tbb::parallel_for(std::size_t{0}, segments.size(), [&](std::size_t k) {
    if (!segments[k].valid()) return;
    const LabelledPerson person{labels, static_cast<std::int16_t>(k),
                                behind_surface(segments[k].seed_m)};
    pictures[k] = draw_depths(scene, person, params_.depth_pose.picture);
  });
  return pictures;
}

PosesInDepths Segmenter::see_depths(const DepthPictures& pictures) const {
  PosesInDepths poses(pictures.size());
  tbb::parallel_for(std::size_t{0}, pictures.size(), [&](std::size_t k) {
    if (pictures[k]) poses[k] = depth_pose_.look(*pictures[k]);
  });
  return poses;
}

PosesInDepths Segmenter::put_bodies_right(const Scene& scene, Heads heads,
                                          std::vector<std::int16_t>& labels,
                                          DepthPictures& pictures, Segments& result) const {
  const auto look = [&] {
    pictures = draw_people(scene, labels, result.segments);
    return see_depths(pictures);
  };
  PosesInDepths poses = look();
  if (heads == Heads::kTold || params_.growing == Growing::kPaper) return poses;
  const SplitBodyParams& params = params_.split_bodies;
  if (join_split_bodies(scene, poses, params, result.segments, labels)) poses = look();
  if (put_seeds_to_heads(poses, params, result.segments, labels)) poses = look();
  return poses;
}

DepthPictures Segmenter::fill_segments(const Scene& scene, std::vector<std::int16_t> labels,
                                       Heads heads, Segments& result) const {
  // The image tells of arms that are in no segment yet.
  const bool image = has_image(scene.cloud), refined = params_.growing != Growing::kPaper;
  if (image && refined) join_arms(scene, labels, result);
  DepthPictures pictures;
  const PosesInDepths poses = put_bodies_right(scene, heads, labels, pictures, result);
  if (image) see_people(scene, labels, result);
  if (image && refined) labels = add_lost_arms(scene, result.segments, std::move(labels), params_);
  for (std::size_t k = 0; k < result.segments.size(); ++k) {
    Segment& segment = result.segments[k];
    segment.id = static_cast<std::int32_t>(k);
    if (!segment.valid()) continue;
    fill_segment(scene, labels, static_cast<std::int16_t>(k), segment);
    add_pose(poses[k], segment);
  }
  return pictures;
}

void Segmenter::fill_segment(const Scene& scene, const std::vector<std::int16_t>& labels,
                             std::int16_t label, Segment& segment) const {
  const RangeImageSource source{scene.cloud, labels, skin_, params_.skin.min_log_ratio,
                                params_.range_image_margin_m};
  if (scene.cloud.organized())
    fill_from_camera(source, label, segment);
  else
    fill_from_scan(source, label, scene.lattice.frame.down(), params_.scan_range_image.focal_px,
                   params_.scan_range_image.gap_px, segment);
}

Segments segment(const Cloud& cloud, const Params& params) {
  return Segmenter(params).segment(cloud);
}

}  // namespace limbcast::segmenter
