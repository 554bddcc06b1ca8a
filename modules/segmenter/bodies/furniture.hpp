#pragma once

#include <cstdint>
#include <vector>

#include "modules/segmenter/growing/joint_growing.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"

namespace limbcast::segmenter {

/// Points of a person's cluster that are no part of the body, but of what it touches: the sofa, the
/// wall, the table. Away from the trunk a body has only limbs, and they are thin; what is wide
/// there and goes on without a step in depth is something else. `points` carry the
/// person's label in `labels`.
std::vector<std::uint32_t> find_furniture(const Lattice& lattice, const HeadCandidate& head,
                                          const std::vector<std::int16_t>& labels,
                                          const std::vector<std::uint32_t>& points,
                                          const FurnitureParams& params);

/// Takes away from all people what they sit on or lean against, and what hangs on that alone.
void leave_furniture(const Lattice& lattice, const FurnitureParams& params, JointGrowth& growth);

}  // namespace limbcast::segmenter
