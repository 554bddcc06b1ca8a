#pragma once

#include <cstdint>
#include <vector>

#include "modules/segmenter/lattice.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/surface_classifier.hpp"
#include "modules/segmenter/surfaces.hpp"

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

/// Surfaces that nobody has and that are as high and wide as a body, with the head on top of them.
std::vector<HeadlessSurface> find_whole_bodies(const Lattice& lattice, const Surfaces& surfaces,
                                               const WholeBodyParams& params);

/// Adds those that are a body's to the people who were found, and the others to the rejected.
void add_headless_people(const Lattice& lattice, const Surfaces& surfaces,
                         const SurfaceClassifier& classifier, const HiddenHeadParams& params,
                         FoundPeople& found);

}  // namespace limbcast::segmenter
