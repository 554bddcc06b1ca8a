#include "modules/segmenter/people_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "modules/segmenter/cluster_figures.hpp"
#include "modules/segmenter/joint_growing.hpp"

namespace limbcast::segmenter {
namespace {

float probability(float odds) { return 1.0F / (1.0F + std::exp(-odds)); }

/// Index of the head to give up next and why; heads.size() where all may stay.
std::size_t weakest(const std::vector<ClusterFigures>& figures, const std::vector<float>& odds,
                    const Params& params, Rejection& why) {
  std::size_t worst = figures.size();
  float worst_odds = std::numeric_limits<float>::max();
  for (std::size_t k = 0; k < figures.size(); ++k) {
    auto rejection = check_validity(figures[k], params.filters);
    if (!rejection && odds[k] < params.classifier.min_person_odds) {
      rejection = Rejection{SegmentFilter::kNotHeadShaped, probability(odds[k]),
                            probability(params.classifier.min_person_odds)};
    }
    if (!rejection || odds[k] >= worst_odds) continue;
    worst = k;
    worst_odds = odds[k];
    why = *rejection;
  }
  return worst;
}

}  // namespace

std::vector<HeadCandidate> likely_heads(const Lattice& lattice,
                                        std::vector<HeadCandidate> candidates,
                                        const HeadClassifier& classifier,
                                        const ClassifierParams& params,
                                        std::vector<RejectedHead>& rejected) {
  for (HeadCandidate& candidate : candidates)
    candidate.odds = classifier.head_odds(lattice, candidate);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const HeadCandidate& a, const HeadCandidate& b) { return a.odds > b.odds; });
  std::vector<HeadCandidate> likely;
  for (const HeadCandidate& candidate : candidates) {
    const float min_odds =
        candidate.kind == SeedKind::kSkin ? params.min_skin_head_odds : params.min_head_odds;
    if (candidate.odds < min_odds) {
      rejected.push_back(
          {candidate,
           {SegmentFilter::kNotHeadShaped, probability(candidate.odds), probability(min_odds)}});
      continue;
    }
    const bool taken = std::any_of(likely.begin(), likely.end(), [&](const HeadCandidate& better) {
      return (better.center_m - candidate.center_m).norm() < params.separation_m;
    });
    if (taken)
      rejected.push_back({candidate, {SegmentFilter::kSamePerson, 1.0F, 0.5F}});
    else
      likely.push_back(candidate);
  }
  return likely;
}

FoundPeople find_people(const Lattice& lattice, std::vector<HeadCandidate> candidates,
                        const HeadClassifier& classifier, const Params& params) {
  FoundPeople found;
  found.heads =
      likely_heads(lattice, std::move(candidates), classifier, params.classifier, found.rejected);
  for (;;) {
    found.labels = grow_together(lattice, found.heads, params.joint, params.reach);
    const std::vector<ClusterFigures> figures =
        measure_clusters(lattice, found.heads, found.labels, params.joint, params.reach);
    found.person_odds.clear();
    for (std::size_t k = 0; k < found.heads.size(); ++k) {
      found.person_odds.push_back(classifier.person_odds(lattice, found.heads[k], figures[k]));
    }
    Rejection why{};
    const std::size_t k = weakest(figures, found.person_odds, params, why);
    if (k == found.heads.size()) return found;
    found.rejected.push_back({found.heads[k], why});
    found.heads.erase(found.heads.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

}  // namespace limbcast::segmenter
