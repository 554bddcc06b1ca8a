#pragma once

#include <vector>

#include "modules/segmenter/growing/cluster_figures.hpp"
#include "modules/segmenter/networks/network.hpp"
#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"

namespace limbcast::segmenter {

/// Tells heads from what looks like them, in two steps: by the depths around a candidate, before
/// anything is grown, and by the figures of the cluster that grew from it. Trained by
/// limbcast-train-heads.
class HeadClassifier {
 public:
  /// The networks that ship with the library.
  HeadClassifier();
  HeadClassifier(Network patch, Network person);

  /// Log odds that the candidate is a head: mean of what its patch and the mirrored one tell.
  float head_odds(const Lattice& lattice, const HeadCandidate& candidate) const;
  /// Log odds that the cluster is a person around this head.
  float person_odds(const Lattice& lattice, const HeadCandidate& head,
                    const ClusterFigures& figures) const;

 private:
  Network patch_, person_;
};

/// The candidate's patch, as the first network reads it.
std::vector<float> patch_input(const Lattice& lattice, const HeadCandidate& candidate,
                               bool mirrored);
/// The cluster's figures, scaled to about one, as the second network reads them; needs head.odds.
std::vector<float> person_input(const Lattice& lattice, const HeadCandidate& head,
                                const ClusterFigures& figures);

}  // namespace limbcast::segmenter
