#pragma once

#include <cstdint>
#include <vector>

#include "modules/segmenter/depth_pose.hpp"
#include "modules/segmenter/head_shape.hpp"
#include "modules/segmenter/lattice.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/scene.hpp"

namespace limbcast::segmenter {

/// Candidates that were refused by the depths around them or by what grew, and may be heads all the
/// same, the likeliest first: apart from the people who were found, on surfaces that nobody has.
std::vector<HeadCandidate> find_overlooked(const Lattice& lattice, const FoundPeople& people,
                                           const OverlookedParams& params);

/// Those of `heads` whose whole bodies the network of depths takes for people. `labels`: the index
/// into `heads` of each of the cloud's points.
std::vector<HeadCandidate> heads_of_people(const Scene& scene,
                                           const std::vector<std::int16_t>& labels,
                                           std::vector<HeadCandidate> heads, const Params& params,
                                           const DepthPose& network);

}  // namespace limbcast::segmenter
