#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/segmenter/head_shape.hpp"
#include "modules/segmenter/lattice.hpp"
#include "modules/segmenter/params.hpp"

namespace limbcast::segmenter {

/// Grows clusters from all heads together over the lattice: each point goes to the head that is
/// nearest along the surface, so that people who touch are parted about half-way between their
/// heads. Returns for each point of the lattice the index of its head, or kNobody.
std::vector<std::int16_t> grow_together(const Lattice& lattice,
                                        const std::vector<HeadCandidate>& heads,
                                        const JointGrowingParams& params, const ReachParams& reach);

}  // namespace limbcast::segmenter
