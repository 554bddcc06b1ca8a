#pragma once

#include <vector>

#include "modules/segmenter/head_shape.hpp"
#include "modules/segmenter/lattice.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/people_search.hpp"

namespace limbcast::segmenter {

/// Candidates that were refused by the depths around them or by what grew, and may be heads all the
/// same, the likeliest first: apart from the people who were found, on surfaces that nobody has.
std::vector<HeadCandidate> find_overlooked(const Lattice& lattice, const FoundPeople& people,
                                           const OverlookedParams& params);

}  // namespace limbcast::segmenter
