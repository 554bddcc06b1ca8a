#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "modules/segmenter/classifiers/surface_classifier.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/scene/surfaces.hpp"

namespace limbcast::segmenter {

/// A surface that nobody with a head in sight explains, and whose own head, if it is a body, must
/// be out of sight: beyond the image's edge, or behind somebody.
struct HeadlessSurface {
  HeadCandidate head;  ///< where its head is guessed to be
  std::vector<std::uint32_t> points;
};

/// `surfaces`: those that nobody has. All of them in a camera's lattice, largest first; none where
/// the ground is not known, which tells how high heads are.
std::vector<HeadlessSurface> find_headless_surfaces(const Lattice& lattice,
                                                    const Surfaces& surfaces,
                                                    const FoundPeople& found,
                                                    const HiddenHeadParams& params);

/// Smaller ones too, and whether or not the head that is guessed would be out of sight.
std::vector<HeadlessSurface> find_body_parts(const Lattice& lattice, const Surfaces& surfaces,
                                             const FoundPeople& found,
                                             const HiddenHeadParams& params);

/// What the colour image shows of the body that a surface may be a part of.
struct SeenBody {
  Eigen::Vector3f head_m;   ///< centre of the head, in sight or not, in the lattice's level frame
  float score_odds = 0.0F;  ///< log odds that somebody is there
  float visible_joints = 0.0F;  ///< how many are in sight: the sum of their visibilities
};

/// Nothing where the image does not tell.
using BodyOpinion = std::function<std::optional<SeenBody>(const HeadlessSurface&)>;

/// Adds a body to the people who were found: a part of one of them, from `first` on, whose head is
/// guessed to be there, too, or somebody else with these log odds.
void add_headless_person(const HeadlessSurface& surface, float odds, std::size_t first,
                         const HiddenHeadParams& params, FoundPeople& found);

/// Adds those that are a body's to the people who were found, and the others to the rejected.
/// Without an image's opinion the head must be out of sight: else it would have been found.
void add_headless_people(const Lattice& lattice, const Surfaces& surfaces,
                         const SurfaceClassifier& classifier, const HiddenHeadParams& params,
                         FoundPeople& found, const BodyOpinion& opinion = nullptr);

}  // namespace limbcast::segmenter
