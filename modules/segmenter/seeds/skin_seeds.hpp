#pragma once

#include <cstdint>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"
#include "modules/segmenter/seeds/skin_color.hpp"

namespace limbcast::segmenter {

/// Connected skin-coloured parts as large as a face or a hand, the largest first; the seed is the
/// part's point nearest to its middle. A step in depth parts two surfaces of one colour.
std::vector<HeadCandidate> find_skin_parts(const Cloud& cloud, const Lattice& lattice,
                                           const SkinColor& skin, const SkinParams& params);

}  // namespace limbcast::segmenter
