#pragma once

#include <cstdint>
#include <vector>

#include "modules/segmenter/classifiers/body_classifier.hpp"
#include "modules/segmenter/growing/joint_growing.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/lattice.hpp"

namespace limbcast::segmenter {

/// Cuts off from each person what the classifier takes for other things, where that is much: the
/// sofa or the wall that grew along with a body. Returns the cut points that may be a body's all
/// the same.
std::vector<std::uint32_t> cut_to_bodies(const Lattice& lattice, const BodyClassifier& classifier,
                                         const BodyCutParams& params, JointGrowth& growth);

}  // namespace limbcast::segmenter
