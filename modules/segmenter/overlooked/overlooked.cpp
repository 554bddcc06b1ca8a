#include "modules/segmenter/overlooked/overlooked.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "modules/segmenter/faces_and_joints/depth_picture.hpp"

namespace limbcast::segmenter {
namespace {

bool is_near(const HeadCandidate& head, const std::vector<HeadCandidate>& others,
             float distance_m) {
  return std::any_of(others.begin(), others.end(), [&](const HeadCandidate& other) {
    return (other.center_m - head.center_m).norm() < distance_m;
  });
}

/// So far from all of `others` across the line of sight: behind a head there is none to be seen.
bool stands_beside(const Lattice& lattice, const HeadCandidate& head,
                   const std::vector<HeadCandidate>& others, float distance_m) {
  return std::all_of(others.begin(), others.end(), [&](const HeadCandidate& other) {
    const Eigen::Vector3f offset_m = from_head(lattice, other, head.center_m);
    return std::hypot(offset_m.x(), offset_m.z()) >= distance_m;
  });
}

/// Of those that are so near to one another the first one alone.
std::vector<HeadCandidate> apart(const std::vector<HeadCandidate>& heads, float distance_m) {
  std::vector<HeadCandidate> kept;
  for (const HeadCandidate& head : heads) {
    if (!is_near(head, kept, distance_m)) kept.push_back(head);
  }
  return kept;
}

/// Filters that end heads beside walls, too: what grew from them went on there.
bool may_be_wrong(SegmentFilter filter) {
  return filter == SegmentFilter::kNotHeadShaped || filter == SegmentFilter::kTooManyPoints ||
         filter == SegmentFilter::kSeedNotHead;
}

/// The head of one of those bodies, where it was asked about or where the network sees it; nothing
/// where the body is no person's.
std::optional<HeadCandidate> tell_head(const Scene& scene, const AskedHeads& asked, std::size_t k,
                                       const Params& params, const DepthPose& network) {
  const OverlookedParams& limits = params.overlooked;
  const HeadCandidate& head = asked.heads[k];
  const auto label = static_cast<std::int16_t>(asked.first_label + static_cast<int>(k));
  const auto see = [&](const Eigen::Vector3f& head_m, float min_odds) {
    return see_body(scene, {asked.labels, label, head_m}, params.depth_pose.picture, network,
                    min_odds);
  };
  const bool is_likely = asked.limits_of_likely && head.odds >= limits.min_likely_head_odds;
  const BodyLimits& lowest = is_likely ? *asked.limits_of_likely : asked.limits;
  const float guess_odds =
      asked.limits.min_person_odds - (asked.heads_move ? limits.guess_costs_odds : 0.0F);
  const Eigen::Vector3f head_m = scene.lattice.frame.to_sensor(head.center_m);
  const auto pose = see(head_m, std::min(guess_odds, lowest.min_person_odds));
  if (!pose) return std::nullopt;
  const auto is_seen = [&limits](const PoseInDepths& body) {
    return body.visibilities[index(Joint::kHead)] >= limits.min_head_visibility;
  };
  const Eigen::Vector3f& seen_m = pose->places_m[index(Joint::kHead)];
  const float error_m = (seen_m - head_m).norm();
  if (asked.heads_move && error_m >= limits.min_moved_m) {
    const auto again = see(seen_m, asked.limits.min_person_odds);
    if (again && is_seen(*again)) {
      const Eigen::Vector3f& again_m = again->places_m[index(Joint::kHead)];
      if (auto moved = head_near(scene.lattice, scene.lattice.frame.to_level(again_m))) {
        moved->kind = head.kind;
        return moved;
      }
    }
  }
  if (asked.heads_move && head.odds < limits.min_unseen_head_odds && !is_seen(*pose))
    return std::nullopt;
  const auto meets = [&](const BodyLimits& wanted) {
    return log_odds(pose->person_score) >= wanted.min_person_odds &&
           error_m < wanted.max_head_error_m;
  };
  if (meets(asked.limits) || meets(lowest)) return head;
  return std::nullopt;
}

}  // namespace

std::vector<HeadCandidate> find_overlooked(const Lattice& lattice, const FoundPeople& people,
                                           const OverlookedParams& params) {
  std::vector<HeadCandidate> refused;
  for (const RejectedHead& rejected : people.rejected) {
    const HeadCandidate& head = rejected.head;
    if (may_be_wrong(rejected.rejection.filter) && !head.told_by_body &&
        head.odds >= params.min_head_odds && head.score >= params.min_template_score &&
        people.labels[lattice.index(head.u, head.v)] == kNobody &&
        !is_near(head, people.heads, params.min_distance_m))
      refused.push_back(head);
  }
  std::stable_sort(refused.begin(), refused.end(),
                   [](const HeadCandidate& a, const HeadCandidate& b) { return a.odds > b.odds; });
  std::vector<HeadCandidate> kept = apart(refused, params.separation_m);
  kept.resize(std::min(kept.size(), static_cast<std::size_t>(params.max_asked)));
  return kept;
}

std::vector<HeadCandidate> find_merged(const Lattice& lattice, const FoundPeople& people,
                                       const OverlookedParams& params) {
  std::vector<HeadCandidate> merged;
  for (const RejectedHead& rejected : people.rejected) {
    if (rejected.rejection.filter == SegmentFilter::kSamePerson &&
        rejected.head.odds >= params.min_merged_odds &&
        stands_beside(lattice, rejected.head, people.heads, params.min_merged_distance_m))
      merged.push_back(rejected.head);
  }
  return apart(merged, params.separation_m);
}

std::optional<PoseInDepths> see_body(const Scene& scene, const LabelledPerson& body,
                                     const DepthPictureParams& picture, const DepthPose& network,
                                     float min_person_odds) {
  const auto drawn = draw_depths(scene, body, picture);
  return drawn ? network.see_person(*drawn, min_person_odds) : std::nullopt;
}

std::vector<HeadCandidate> heads_of_people(const Scene& scene, const AskedHeads& asked,
                                           const Params& params, const DepthPose& network) {
  std::vector<std::optional<HeadCandidate>> told(asked.heads.size());
  tbb::parallel_for(std::size_t{0}, told.size(),
                    [&](std::size_t k) { told[k] = tell_head(scene, asked, k, params, network); });
  std::vector<HeadCandidate> heads;
  for (const std::optional<HeadCandidate>& head : told) {
    if (!head) continue;
    heads.push_back(*head);
    heads.back().told_by_body = true;
    heads.back().odds = params.overlooked.head_odds;
  }
  return heads;
}

}  // namespace limbcast::segmenter
