#include "modules/segmenter/overlooked/overlooked.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "modules/segmenter/faces_and_joints/depth_picture.hpp"
#include "modules/segmenter/faces_and_joints/labelled_person.hpp"

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

std::vector<HeadCandidate> heads_of_people(const Scene& scene, AskedHeads asked,
                                           const Params& params, const DepthPose& network) {
  std::vector<HeadCandidate>& heads = asked.heads;
  tbb::parallel_for(std::size_t{0}, heads.size(), [&](std::size_t k) {
    const auto label = static_cast<std::int16_t>(asked.first_label + static_cast<int>(k));
    const LabelledPerson body{asked.labels, label,
                              scene.lattice.frame.to_sensor(heads[k].center_m)};
    const auto picture = draw_depths(scene, body, params.depth_pose.picture);
    const bool is_likely =
        asked.limits_of_likely && heads[k].odds >= params.overlooked.min_likely_head_odds;
    const BodyLimits& lowest = is_likely ? *asked.limits_of_likely : asked.limits;
    const auto pose = picture ? network.see_person(*picture, lowest.min_person_odds) : std::nullopt;
    const auto meets = [&](const BodyLimits& limits) {
      return log_odds(pose->person_score) >= limits.min_person_odds &&
             (pose->places_m[index(Joint::kHead)] - body.head_m).norm() < limits.max_head_error_m;
    };
    heads[k].told_by_body = pose && (meets(asked.limits) || meets(lowest));
  });
  heads.erase(std::remove_if(heads.begin(), heads.end(),
                             [](const HeadCandidate& head) { return !head.told_by_body; }),
              heads.end());
  for (HeadCandidate& head : heads) head.odds = params.overlooked.head_odds;
  return std::move(asked.heads);
}

}  // namespace limbcast::segmenter
