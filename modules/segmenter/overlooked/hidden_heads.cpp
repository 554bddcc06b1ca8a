#include "modules/segmenter/overlooked/hidden_heads.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "modules/segmenter/overlooked/head_view.hpp"

namespace limbcast::segmenter {
namespace {

/// What lies on one surface, and where.
struct Extent {
  std::vector<std::uint32_t> points;
  Eigen::Vector3f mean_m = Eigen::Vector3f::Zero();
  float top_m = 0.0F, bottom_m = 0.0F;
};

Extent measure(const Lattice& lattice, std::vector<std::uint32_t> points) {
  Extent extent;
  std::vector<float> heights_m;
  heights_m.reserve(points.size());
  for (const std::uint32_t i : points) {
    extent.mean_m += lattice.level_m[i];
    heights_m.push_back(lattice.level_m[i].z());
  }
  extent.mean_m /= static_cast<float>(points.size());
  std::sort(heights_m.begin(), heights_m.end());
  // A twentieth at both ends may be noise of the matcher.
  extent.bottom_m = heights_m[heights_m.size() / 20];
  extent.top_m = heights_m[heights_m.size() - 1 - heights_m.size() / 20];
  extent.points = std::move(points);
  return extent;
}

bool has_size_of_body(const Surface& surface, const HiddenHeadParams& params) {
  return surface.area_m2 >= params.min_area_m2 && surface.area_m2 <= params.max_area_m2 &&
         surface.extent_m <= params.max_extent_m;
}

/// The likeliest place of the head over a surface that is out of sight.
std::optional<Eigen::Vector3f> guess_head(const HeadView& view, const Extent& extent,
                                          const HiddenHeadParams& params) {
  std::optional<Eigen::Vector3f> best;
  float least = 1e9F;
  for (const float height_m : params.head_heights_m) {
    for (const float across_m : params.across_m) {
      const Eigen::Vector3f head_m(extent.mean_m.x() + across_m,
                                   extent.mean_m.y() + params.trunk_depth_m, height_m);
      const float unlikely =
          std::abs(across_m) + std::abs(height_m - params.head_heights_m.front());
      if (unlikely >= least || !view.hides_head(head_m)) continue;
      least = unlikely;
      best = head_m;
    }
  }
  return best;
}

float level_distance_m(const HeadCandidate& head, const Eigen::Vector3f& place_m) {
  return (head.center_m - place_m).head<2>().norm();
}

bool near_a_head(const std::vector<HeadCandidate>& heads, const Eigen::Vector3f& place_m,
                 float distance_m) {
  return std::any_of(heads.begin(), heads.end(), [&](const HeadCandidate& head) {
    return level_distance_m(head, place_m) < distance_m;
  });
}

/// Surfaces of a body's size that are as high as this and stand apart from all who were found.
std::vector<Extent> free_extents(const Lattice& lattice, const Surfaces& surfaces,
                                 const FoundPeople& found, const HiddenHeadParams& params,
                                 float min_height_m) {
  std::vector<Extent> extents;
  std::vector<std::vector<std::uint32_t>> points = points_by_surface(surfaces);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!has_size_of_body(surfaces.all[k], params)) continue;
    Extent extent = measure(lattice, std::move(points[k]));
    if (extent.top_m - extent.bottom_m >= min_height_m &&
        !near_a_head(found.heads, extent.mean_m, params.min_distance_m))
      extents.push_back(std::move(extent));
  }
  return extents;
}

HeadlessSurface with_head(const Lattice& lattice, const Eigen::Vector3f& head_m, Extent extent) {
  HeadlessSurface surface;
  surface.head.center_m = head_m;
  surface.head.surface_m = head_surface(lattice, head_m);
  surface.head.kind = SeedKind::kBody;
  surface.points = std::move(extent.points);
  return surface;
}

std::vector<HeadlessSurface> largest_first(std::vector<HeadlessSurface> surfaces) {
  std::stable_sort(surfaces.begin(), surfaces.end(),
                   [](const HeadlessSurface& a, const HeadlessSurface& b) {
                     return a.points.size() > b.points.size();
                   });
  return surfaces;
}

/// Log odds of a body, and the least that is taken for one.
struct Judgement {
  float odds = 0.0F, least = 0.0F;
};

/// By its depths alone: only where a head would be out of sight, which tells much itself.
Judgement judge_by_depths(float depth_odds, const HiddenHeadParams& params) {
  return {depth_odds + params.place_odds, params.min_body_odds + params.place_odds};
}

Judgement judge_by_image(float depth_odds, const SeenBody& seen, const HiddenHeadParams& params) {
  const float score_odds =
      std::clamp(seen.score_odds, -params.max_score_odds, params.max_score_odds);
  return {params.base_odds + params.depth_odds * depth_odds + params.score_odds * score_odds +
              params.joint_odds * seen.visible_joints,
          params.min_seen_odds};
}

}  // namespace

std::vector<HeadlessSurface> find_headless_surfaces(const Lattice& lattice,
                                                    const Surfaces& surfaces,
                                                    const FoundPeople& found,
                                                    const HiddenHeadParams& params) {
  if (!lattice.frame.ground_known) return {};
  const HeadView view(lattice, found, params);
  std::vector<HeadlessSurface> headless;
  for (Extent& extent : free_extents(lattice, surfaces, found, params, params.min_height_m)) {
    const auto head_m = guess_head(view, extent, params);
    if (!head_m || near_a_head(found.heads, *head_m, params.min_distance_m)) continue;
    headless.push_back(with_head(lattice, *head_m, std::move(extent)));
  }
  return largest_first(std::move(headless));
}

std::vector<HeadlessSurface> find_body_parts(const Lattice& lattice, const Surfaces& surfaces,
                                             const FoundPeople& found,
                                             const HiddenHeadParams& params) {
  if (!lattice.frame.ground_known) return {};
  std::vector<HeadlessSurface> parts;
  for (Extent& extent : free_extents(lattice, surfaces, found, params, params.min_part_height_m)) {
    const float height_m =
        extent.top_m > params.min_shoulder_m ? extent.top_m : params.head_heights_m.front();
    const Eigen::Vector3f head_m(extent.mean_m.x(), extent.mean_m.y() + params.trunk_depth_m,
                                 height_m);
    parts.push_back(with_head(lattice, head_m, std::move(extent)));
  }
  return largest_first(std::move(parts));
}

void add_headless_person(const HeadlessSurface& surface, float odds, std::size_t first,
                         const HiddenHeadParams& params, FoundPeople& found) {
  // Somebody before a body may part it: its other surfaces are the same person's.
  const auto known =
      std::find_if(found.heads.begin() + static_cast<std::ptrdiff_t>(first), found.heads.end(),
                   [&](const HeadCandidate& head) {
                     return level_distance_m(head, surface.head.center_m) < params.min_distance_m;
                   });
  const auto label = static_cast<std::int16_t>(known - found.heads.begin());
  for (const std::uint32_t i : surface.points) found.labels[i] = label;
  if (known != found.heads.end()) return;
  found.heads.push_back(surface.head);
  found.person_odds.push_back(odds);
}

void add_headless_people(const Lattice& lattice, const Surfaces& surfaces,
                         const SurfaceClassifier& classifier, const HiddenHeadParams& params,
                         FoundPeople& found, const BodyOpinion& opinion) {
  const std::size_t first = found.heads.size();
  int asked = 0;
  for (HeadlessSurface& surface : opinion
                                      ? find_body_parts(lattice, surfaces, found, params)
                                      : find_headless_surfaces(lattice, surfaces, found, params)) {
    if (opinion && asked == params.max_asked) break;
    const float depth_odds = classifier.mean_odds(lattice, surface.points);
    Judgement judgement = judge_by_depths(depth_odds, params);
    if (opinion) {
      if (depth_odds < params.min_part_odds) continue;
      ++asked;
      const std::optional<SeenBody> seen = opinion(surface);
      if (!seen) continue;
      judgement = judge_by_image(depth_odds, *seen, params);
      surface.head.center_m = seen->head_m;
      surface.head.surface_m = head_surface(lattice, seen->head_m);
    }
    if (judgement.odds < judgement.least) {
      found.rejected.push_back({surface.head,
                                {SegmentFilter::kNotHeadShaped, probability(judgement.odds),
                                 probability(judgement.least)}});
      continue;
    }
    add_headless_person(surface, judgement.odds, first, params, found);
  }
}

}  // namespace limbcast::segmenter
