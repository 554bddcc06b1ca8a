#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "modules/segmenter/classifiers/body_classifier.hpp"
#include "modules/segmenter/classifiers/head_classifier.hpp"
#include "modules/segmenter/growing/filters.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"

namespace limbcast::segmenter {

struct RejectedHead {
  HeadCandidate head;
  Rejection rejection;
};

/// The people of one lattice.
struct FoundPeople {
  std::vector<HeadCandidate> heads;
  std::vector<float> person_odds;    ///< one for each head
  std::vector<std::int16_t> labels;  ///< head of each point of the lattice, kNobody or kUnsure
  std::vector<RejectedHead> rejected;
};

/// Log odds that a candidate is a head, of somebody who sees more than the depths around it;
/// nothing where that tells nothing.
using HeadOpinion = std::function<std::optional<float>(const HeadCandidate&)>;

/// Sets `odds` of each candidate, drops the unlikely ones and those that a likelier one stands for.
/// `opinion`, where there is one, is asked of the likeliest of those that are unsure.
std::vector<HeadCandidate> likely_heads(const Lattice& lattice,
                                        std::vector<HeadCandidate> candidates,
                                        const HeadClassifier& classifier,
                                        const ClassifierParams& params,
                                        std::vector<RejectedHead>& rejected,
                                        const HeadOpinion& opinion = {});

/// Grows all candidates together, and again without the least likely one until all are people; then
/// cuts off what is no part of them.
FoundPeople find_people(const Lattice& lattice, std::vector<HeadCandidate> candidates,
                        const HeadClassifier& classifier, const BodyClassifier& bodies,
                        const Params& params, const HeadOpinion& opinion = {});

}  // namespace limbcast::segmenter
