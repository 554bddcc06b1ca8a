#include "modules/segmenter/classifiers/head_classifier.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "modules/segmenter/classifiers/head_patch.hpp"

namespace limbcast::segmenter {
namespace {

#include "modules/segmenter/classifiers/head_networks.inc"

}  // namespace

HeadClassifier::HeadClassifier() : HeadClassifier(unpack(kPatchNetwork), unpack(kPersonNetwork)) {
  if (kPatchNetwork.inputs != kPatchSize)
    throw std::logic_error("head_networks.inc: trained for other patches; run train.sh");
}

HeadClassifier::HeadClassifier(Network patch, Network person)
    : patch_(std::move(patch)), person_(std::move(person)) {}

std::vector<float> patch_input(const Lattice& lattice, const HeadCandidate& candidate,
                               bool mirrored) {
  const auto at = static_cast<std::uint32_t>(lattice.index(candidate.u, candidate.v));
  PatchPlace place = place_of_point(lattice, at, mirrored);
  place.height_m = candidate.surface_m.z();
  return sample_patch(lattice, place);
}

std::vector<float> person_input(const Lattice& lattice, const HeadCandidate& head,
                                const ClusterFigures& figures) {
  const float known = lattice.frame.ground_known ? 1.0F : 0.0F;
  return {std::clamp(head.odds, -10.0F, 10.0F) / 5.0F,
          std::log(figures.area_m2 + 0.02F),
          4.0F * figures.head_width_m,
          2.0F * figures.shoulder_width_m,
          2.0F * figures.torso_width_m,
          figures.drop_m,
          2.0F * figures.rise_m,
          5.0F * figures.edge_share,
          5.0F * figures.over_head_share,
          3.0F * figures.offset_m,
          2.0F * figures.seed_over_centroid_m,
          figures.density,
          10.0F * figures.head_relief_m,
          std::log(figures.head_roughness_m + 0.003F) / 2.0F,
          4.0F * figures.torso_depth_m,
          figures.open_share * 5.0F,
          known,
          known * (head.center_m.z() - 1.35F) / 0.5F,
          known * (head.center_m.z() - figures.drop_m)};
}

float HeadClassifier::head_odds(const Lattice& lattice, const HeadCandidate& candidate) const {
  return 0.5F * (patch_.log_odds(patch_input(lattice, candidate, false)) +
                 patch_.log_odds(patch_input(lattice, candidate, true)));
}

float HeadClassifier::person_odds(const Lattice& lattice, const HeadCandidate& head,
                                  const ClusterFigures& figures) const {
  return person_.log_odds(person_input(lattice, head, figures));
}

}  // namespace limbcast::segmenter
