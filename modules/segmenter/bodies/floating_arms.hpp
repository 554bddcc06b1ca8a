#pragma once

#include "modules/segmenter/params.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/scene/lattice.hpp"

namespace limbcast::segmenter {

/// Growing ends where a range finder's beams pass between two parts of an arm, where the trunk
/// hides what joins it to the shoulder, or where the depth's noise parts it. Small surfaces of
/// nobody's that hang in the air near a person, as furniture does not, become the nearest person's.
void add_floating_arms(const Lattice& lattice, const FloatingArmParams& params,
                       FoundPeople& people);

}  // namespace limbcast::segmenter
