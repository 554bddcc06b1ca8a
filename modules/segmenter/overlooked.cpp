#include "modules/segmenter/overlooked.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "modules/segmenter/depth_picture.hpp"
#include "modules/segmenter/labelled_person.hpp"

namespace limbcast::segmenter {
namespace {

bool is_near(const HeadCandidate& head, const std::vector<HeadCandidate>& others,
             float distance_m) {
  return std::any_of(others.begin(), others.end(), [&](const HeadCandidate& other) {
    return (other.center_m - head.center_m).norm() < distance_m;
  });
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
  std::vector<HeadCandidate> kept;
  for (const HeadCandidate& head : refused) {
    if (static_cast<int>(kept.size()) == params.max_asked) break;
    if (!is_near(head, kept, params.separation_m)) kept.push_back(head);
  }
  return kept;
}

std::vector<HeadCandidate> heads_of_people(const Scene& scene,
                                           const std::vector<std::int16_t>& labels,
                                           std::vector<HeadCandidate> heads, const Params& params,
                                           const DepthPose& network) {
  tbb::parallel_for(std::size_t{0}, heads.size(), [&](std::size_t k) {
    HeadCandidate& head = heads[k];
    const LabelledPerson body{labels, static_cast<std::int16_t>(k),
                              scene.lattice.frame.to_sensor(head.center_m)};
    const auto picture = draw_depths(scene, body, params.depth_pose.picture);
    head.told_by_body =
        picture && network.see_person(*picture, params.overlooked.min_person_odds).has_value();
  });
  heads.erase(std::remove_if(heads.begin(), heads.end(),
                             [](const HeadCandidate& head) { return !head.told_by_body; }),
              heads.end());
  for (HeadCandidate& head : heads) head.odds = params.overlooked.head_odds;
  return heads;
}

}  // namespace limbcast::segmenter
