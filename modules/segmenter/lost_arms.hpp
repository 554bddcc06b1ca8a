#pragma once

#include <cstdint>
#include <vector>

#include "common/cloud/segment.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene.hpp"

namespace limbcast::segmenter {

/// `labels`, the segment of each point of a camera's cloud, with what growing and cutting left of
/// arms that the image shows: small surfaces that nobody has where `image_poses` of a valid segment
/// mark a forearm. Of two networks the second is believed, which marks wrists more exactly.
std::vector<std::int16_t> add_lost_arms(const Scene& scene, const std::vector<Segment>& segments,
                                        std::vector<std::int16_t> labels, const Params& params);

}  // namespace limbcast::segmenter
