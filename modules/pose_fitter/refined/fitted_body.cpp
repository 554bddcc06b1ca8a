#include "modules/pose_fitter/refined/fitted_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/pose_fitter/refined/search/pose_search.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Logarithm of the odds that the candidate began at a head; one begun at skin alone was not
/// judged.
Real head_odds(const Segment& segment) {
  constexpr Real kUnjudged = 3.0, kMost = 5.0;  // the median of people; more tells nothing new
  if (segment.seed_kind == SeedKind::kSkin) return kUnjudged;
  const Real score = segment.seed_score;
  return std::clamp(std::log(score / std::max(1e-6, 1.0 - score)), -kMost, kMost);
}

}  // namespace

std::optional<FittedBody> fit_body(const Segment& segment, const Stamp& stamp,
                                   const RefinedParams& params) {
  std::optional<Observation> observation = observe(segment, stamp, params);
  if (!observation) return std::nullopt;
  PoseSearch search(*observation, params);
  const std::vector<PoseCandidate> candidates = search.run();
  FittedBody fitted;
  fitted.body = candidates.front().body;
  fitted.cost = candidates.front().cost;
  fitted.evidence = gather_evidence(candidates, search.moves());
  fitted.evidence.head_odds = head_odds(segment);
  fitted.person = gather_person_evidence(fitted.body, *observation);
  fitted.observation = std::move(*observation);
  return fitted;
}

}  // namespace limbcast::pose_fitter::refined
