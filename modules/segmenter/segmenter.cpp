#include "modules/segmenter/segmenter.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "modules/segmenter/cluster_figures.hpp"
#include "modules/segmenter/filters.hpp"
#include "modules/segmenter/ground.hpp"
#include "modules/segmenter/head_shape.hpp"
#include "modules/segmenter/joint_growing.hpp"
#include "modules/segmenter/lattice.hpp"
#include "modules/segmenter/range_image.hpp"

namespace limbcast::segmenter {
namespace {

/// Focal length of the thinned lattice [px]: a head at 4 m is then 12 pixels wide.
constexpr double kLatticeFocal_px = 260.0;
constexpr float kMaxTemplateScore = 2.48F;

std::optional<Rejection> check(const ClusterFigures& figures, const Params& params) {
  if (const auto rejection = check_validity(figures, params.filters)) return rejection;
  return check_person(figures, params.person);
}

/// A shoulder, a breast or a knee looks like a head to the template; what stands over it tells.
std::optional<Rejection> check_above(const std::vector<HeadCandidate>& heads, std::size_t k) {
  for (const HeadCandidate& other : heads) {
    const Eigen::Vector3f d = other.center_m - heads[k].center_m;
    if (d.z() > 0.12F && d.z() < 0.7F && d.head<2>().norm() < 0.40F &&
        other.score > heads[k].score - 0.15F) {
      return Rejection{SegmentFilter::kSamePerson, 1.0F, 0.5F};
    }
  }
  return std::nullopt;
}

Segment make_segment(const HeadCandidate& head, const LevelFrame& frame) {
  Segment segment;
  segment.seed_m = frame.to_sensor(head.surface_m);
  segment.seed_kind = SeedKind::kHeadShape;
  segment.seed_score = std::min(1.0F, head.score / kMaxTemplateScore);
  return segment;
}

}  // namespace

Segmenter::Segmenter(const Params& params) : params_(params) {}

Segments Segmenter::segment(const Cloud& cloud) const {
  Segments result;
  result.stamp = cloud.stamp;
  if (!cloud.organized() || cloud.points_m.empty()) return result;
  const LevelFrame frame =
      make_level_frame(cloud.stamp.gravity, find_ground(cloud, params_.ground));
  const int step = std::max(1, static_cast<int>(std::lround(cloud.camera->fx / kLatticeFocal_px)));
  const Lattice lattice = thin(cloud, frame, step);

  std::vector<HeadCandidate> heads = find_heads(lattice, params_.head);
  std::vector<Segment> rejected;
  const auto reject = [&](std::size_t k, const Rejection& rejection) {
    Segment segment = make_segment(heads[k], frame);
    segment.rejected_by = rejection.filter;
    segment.filter_figure = rejection.figure;
    segment.filter_limit = rejection.limit;
    rejected.push_back(std::move(segment));
    heads.erase(heads.begin() + static_cast<std::ptrdiff_t>(k));
  };
  for (std::size_t k = heads.size(); k-- > 0;) {
    if (const auto rejection = check_above(heads, k)) reject(k, *rejection);
  }
  // Candidates that are no heads steal points from the people beside them: the weakest one that
  // fails goes, then all grow again without it.
  std::vector<std::int16_t> labels;
  for (bool changed = true; changed;) {
    changed = false;
    labels = grow_together(lattice, heads, params_.joint, params_.reach);
    const std::vector<ClusterFigures> figures =
        measure_clusters(lattice, heads, labels, params_.reach);
    for (std::size_t k = heads.size(); k-- > 0 && !changed;) {
      const auto rejection = check(figures[k], params_);
      if (!rejection) continue;
      reject(k, *rejection);
      changed = true;
    }
  }

  const std::vector<std::int16_t> dense = thicken(cloud, lattice, step, labels, params_.joint);
  for (std::size_t k = 0; k < heads.size(); ++k) {
    Segment segment = make_segment(heads[k], frame);
    fill_from_camera(cloud, dense, static_cast<std::int16_t>(k), params_.range_image_margin_m,
                     skin_, params_.skin.min_log_ratio, segment);
    result.segments.push_back(std::move(segment));
  }
  std::move(rejected.begin(), rejected.end(), std::back_inserter(result.segments));
  for (std::size_t k = 0; k < result.segments.size(); ++k)
    result.segments[k].id = static_cast<std::int32_t>(k);
  return result;
}

Segments segment(const Cloud& cloud, const Params& params) {
  return Segmenter(params).segment(cloud);
}

}  // namespace limbcast::segmenter
