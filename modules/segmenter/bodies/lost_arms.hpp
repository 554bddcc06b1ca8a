#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/cloud/segment.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/scene.hpp"

namespace limbcast::segmenter {

/// What the image shows of the person who has a label among the cloud's points.
using PersonLook =
    std::function<std::optional<ImagePose>(const std::vector<std::int16_t>& labels, std::int16_t)>;

/// A raised hand may look like a head, and gets a segment. Small segments in which the image marks
/// the elbow or wrist of somebody beside them, once they are nobody's, are rejected as the same
/// person, and their points become that person's.
void join_arms_taken_for_heads(const Scene& scene, const PersonLook& look,
                               const LostArmParams& params, std::vector<Segment>& segments,
                               std::vector<std::int16_t>& labels);

/// `labels`, the segment of each point of a camera's cloud, with what growing and cutting left of
/// arms that the image shows: small surfaces that nobody has where `image_poses` of a valid segment
/// mark a forearm. Of two networks the second is believed, which marks wrists more exactly.
std::vector<std::int16_t> add_lost_arms(const Scene& scene, const std::vector<Segment>& segments,
                                        std::vector<std::int16_t> labels, const Params& params);

}  // namespace limbcast::segmenter
