#include "modules/segmenter/people_search.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "modules/segmenter/bodies/body_cut.hpp"
#include "modules/segmenter/bodies/furniture.hpp"
#include "modules/segmenter/growing/cluster_figures.hpp"
#include "modules/segmenter/growing/joint_growing.hpp"

namespace limbcast::segmenter {
namespace {

/// What became of the heads while they grow together.
class Trial {
 public:
  Trial(const Lattice& lattice, std::vector<HeadCandidate> heads, const HeadClassifier& classifier,
        const Params& params)
      : lattice_(&lattice),
        classifier_(&classifier),
        params_(&params),
        growth_(lattice, std::move(heads), params.joint, params.reach),
        verdicts_(growth_.heads().size()) {
    for (std::size_t k = 0; k < verdicts_.size(); ++k) judge(static_cast<std::int16_t>(k));
  }

  /// Gives up a seed on the body of a person whose head is a seed too: where two are near, and the
  /// one that looks more like a head makes about as likely a person alone as both do. Nothing where
  /// no two are one person's.
  std::optional<RejectedHead> drop_rival() {
    std::optional<std::pair<std::size_t, std::size_t>> best;
    float best_gain = -params_->classifier.rival_odds;
    for (const auto& [head, other] : rivals()) {
      const std::vector<Verdict> before = verdicts_;
      const float value_before = value(head) + value_as_head(other);
      const float taken = give(other, head);
      const float gain = value(head) - value_before;
      growth_.undo_drop();
      verdicts_ = before;
      if (taken <= kSamePersonShare || gain <= best_gain) continue;
      best_gain = gain;
      best = {head, other};
    }
    if (!best) return std::nullopt;
    const auto [head, other] = *best;
    const float taken = give(other, head);
    return RejectedHead{growth_.heads()[other],
                        {SegmentFilter::kSamePerson, taken, kSamePersonShare}};
  }

  /// Gives up the least likely head that is no person's; nothing where all are.
  std::optional<RejectedHead> drop_weakest() {
    std::optional<std::size_t> weakest;
    for (std::size_t k = 0; k < verdicts_.size(); ++k) {
      if (!verdicts_[k].rejection || growth_.dropped(static_cast<std::int16_t>(k))) continue;
      if (!weakest || verdicts_[k].odds < verdicts_[*weakest].odds) weakest = k;
    }
    if (!weakest) return std::nullopt;
    for (const std::int16_t k : growth_.drop(static_cast<std::int16_t>(*weakest))) judge(k);
    return RejectedHead{growth_.heads()[*weakest], *verdicts_[*weakest].rejection};
  }

  void leave_furniture() { segmenter::leave_furniture(*lattice_, params_->furniture, growth_); }

  /// Cuts off what is no part of a body. Returns the heads that are nearly all cut off: no people.
  std::vector<RejectedHead> cut_to_bodies(const BodyClassifier& bodies) {
    const std::vector<int> before = count_points();
    unsure_ = segmenter::cut_to_bodies(*lattice_, bodies, params_->body_cut, growth_);
    const std::vector<int> after = count_points();
    const float min_share = params_->body_cut.min_left_share;
    std::vector<RejectedHead> rejected;
    for (std::size_t k = 0; k < after.size(); ++k) {
      if (growth_.dropped(static_cast<std::int16_t>(k)) || before[k] == 0) continue;
      // Somebody beside a wall or on a sofa, whose body was seen already.
      if (growth_.heads()[k].told_by_body) continue;
      const float share = static_cast<float>(after[k]) / static_cast<float>(before[k]);
      if (share >= min_share) continue;
      growth_.drop(static_cast<std::int16_t>(k));
      rejected.push_back({growth_.heads()[k], {SegmentFilter::kNotHeadShaped, share, min_share}});
    }
    return rejected;
  }

  /// The heads that are left, and their points.
  void name_people(FoundPeople& found) const {
    std::vector<std::int16_t> name_of(verdicts_.size(), kNobody);
    for (std::size_t k = 0; k < verdicts_.size(); ++k) {
      if (growth_.dropped(static_cast<std::int16_t>(k))) continue;
      name_of[k] = static_cast<std::int16_t>(found.heads.size());
      found.heads.push_back(growth_.heads()[k]);
      found.person_odds.push_back(verdicts_[k].odds);
    }
    found.labels = growth_.labels();
    for (std::int16_t& label : found.labels) {
      if (label != kNobody) label = name_of[static_cast<std::size_t>(label)];
    }
    for (const std::uint32_t i : unsure_) {
      if (found.labels[i] == kNobody) found.labels[i] = kUnsure;
    }
  }

 private:
  struct Verdict {
    float odds = 0.0F;
    std::optional<Rejection> rejection;
  };

  /// Points of each head.
  std::vector<int> count_points() const {
    std::vector<int> counts(growth_.heads().size(), 0);
    for (const std::int16_t label : growth_.labels()) {
      if (label != kNobody) ++counts[static_cast<std::size_t>(label)];
    }
    return counts;
  }

  /// Pairs of seeds that may be one person's, the one that looks more like a head first.
  std::vector<std::pair<std::size_t, std::size_t>> rivals() const {
    const std::vector<HeadCandidate>& heads = growth_.heads();
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < heads.size(); ++k) {
      if (!growth_.dropped(static_cast<std::int16_t>(k))) left.push_back(k);
    }
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const std::size_t a : left) {
      for (const std::size_t b : left) {
        const bool ordered =
            heads[a].odds > heads[b].odds || (heads[a].odds == heads[b].odds && a < b);
        if (heads[b].stands_beside) continue;
        if (ordered && (heads[a].center_m - heads[b].center_m).norm() < params_->classifier.rival_m)
          pairs.emplace_back(a, b);
      }
    }
    return pairs;
  }

  /// How likely a head is a person's, beyond an even chance; zero for one that will be given up.
  float value(std::size_t k) const {
    return verdicts_[k].rejection ? 0.0F : std::max(0.0F, verdicts_[k].odds);
  }

  /// The same of a seed on a body that may be another's: whatever grew from it, it is no likelier a
  /// person than it is a head.
  float value_as_head(std::size_t k) const {
    return std::min(value(k), std::max(0.0F, growth_.heads()[k].odds));
  }

  /// Drops `from` and returns the share of its points that `to` took over.
  float give(std::size_t from, std::size_t to) {
    for (const std::int16_t k : growth_.drop(static_cast<std::int16_t>(from))) judge(k);
    const std::vector<std::uint32_t>& freed = growth_.freed();
    const auto taken = std::count_if(freed.begin(), freed.end(), [&](std::uint32_t i) {
      return growth_.labels()[i] == static_cast<std::int16_t>(to);
    });
    return freed.empty() ? 0.0F : static_cast<float>(taken) / static_cast<float>(freed.size());
  }

  void judge(std::int16_t k) {
    const HeadCandidate& head = growth_.heads()[static_cast<std::size_t>(k)];
    const ClusterFigures figures =
        measure_cluster(*lattice_, head, growth_.labels(), k, params_->joint, params_->reach);
    Verdict& verdict = verdicts_[static_cast<std::size_t>(k)];
    verdict.odds = classifier_->person_odds(*lattice_, head, figures);
    // What grew along with a sure head, or what others hide of it, makes it no less of a head.
    if (head.odds > params_->classifier.sure_head_odds) {
      verdict.odds = std::max(verdict.odds, head.odds);
      return;
    }
    verdict.rejection = check_validity(figures, params_->filters);
    const float min_odds = params_->classifier.min_person_odds;
    if (!verdict.rejection && verdict.odds < min_odds) {
      verdict.rejection = Rejection{SegmentFilter::kNotHeadShaped, probability(verdict.odds),
                                    probability(min_odds)};
    }
  }

  const Lattice* lattice_;
  const HeadClassifier* classifier_;
  const Params* params_;
  JointGrowth growth_;
  std::vector<Verdict> verdicts_;
  std::vector<std::uint32_t> unsure_;  ///< points that were cut off, but may be a body's
};

}  // namespace

std::vector<HeadCandidate> likely_heads(const Lattice& lattice,
                                        std::vector<HeadCandidate> candidates,
                                        const HeadClassifier& classifier,
                                        const ClassifierParams& params,
                                        std::vector<RejectedHead>& rejected,
                                        const HeadOpinion& opinion) {
  const float prior_odds = lattice.wraps_around ? params.panorama_odds : 0.0F;
  const float min_head_odds =
      lattice.wraps_around ? params.min_panorama_head_odds : params.min_head_odds;
  for (HeadCandidate& candidate : candidates) {
    if (!candidate.told_by_body)
      candidate.odds = classifier.head_odds(lattice, candidate) + prior_odds;
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const HeadCandidate& a, const HeadCandidate& b) { return a.odds > b.odds; });
  int asked = 0;
  std::vector<HeadCandidate> likely;
  for (HeadCandidate& candidate : candidates) {
    const bool taken = std::any_of(likely.begin(), likely.end(), [&](const HeadCandidate& better) {
      return (better.center_m - candidate.center_m).norm() < params.separation_m;
    });
    const bool unsure = candidate.odds > params.min_asked_odds &&
                        candidate.odds < params.sure_head_odds && candidate.kind != SeedKind::kSkin;
    if (opinion && unsure && !taken && asked < params.max_asked) {
      ++asked;
      candidate.odds = opinion(candidate).value_or(candidate.odds);
    }
    const float min_odds =
        candidate.kind == SeedKind::kSkin ? params.min_skin_head_odds : min_head_odds;
    if (candidate.odds < min_odds) {
      rejected.push_back(
          {candidate,
           {SegmentFilter::kNotHeadShaped, probability(candidate.odds), probability(min_odds)}});
    } else if (taken) {
      rejected.push_back({candidate, {SegmentFilter::kSamePerson, 1.0F, kSamePersonShare}});
    } else {
      likely.push_back(candidate);
    }
  }
  return likely;
}

FoundPeople find_people(const Lattice& lattice, std::vector<HeadCandidate> candidates,
                        const HeadClassifier& classifier, const BodyClassifier& bodies,
                        const Params& params, const HeadOpinion& opinion) {
  FoundPeople found;
  std::vector<HeadCandidate> likely = likely_heads(lattice, std::move(candidates), classifier,
                                                   params.classifier, found.rejected, opinion);
  Trial trial(lattice, std::move(likely), classifier, params);
  while (const auto rejected = trial.drop_rival()) found.rejected.push_back(*rejected);
  while (const auto rejected = trial.drop_weakest()) found.rejected.push_back(*rejected);
  trial.leave_furniture();
  for (const RejectedHead& rejected : trial.cut_to_bodies(bodies))
    found.rejected.push_back(rejected);
  trial.name_people(found);
  return found;
}

}  // namespace limbcast::segmenter
