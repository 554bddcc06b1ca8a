#include "modules/segmenter/overlooked.hpp"

#include <algorithm>

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

}  // namespace limbcast::segmenter
