#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/cloud/segment.hpp"
#include "modules/segmenter/faces_and_joints/depth_pose.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/scene.hpp"

namespace limbcast::segmenter {

/// What the network of depths sees of each segment; nothing of rejected ones.
using PosesInDepths = std::vector<std::optional<PoseInDepths>>;

/// Somebody who bends down is found by what is uppermost: the back, and often the head too, so that
/// there are two segments, each of half a body. Segments that hold limbs of a person whose head the
/// network sees in another one, and no head of their own or one that is seen worse, are rejected as
/// the same person; `labels`, the segment of each point of the cloud, give their points to that
/// person. Returns whether there were any.
bool join_split_bodies(const Scene& scene, const PosesInDepths& poses,
                       const SplitBodyParams& params, std::vector<Segment>& segments,
                       std::vector<std::int16_t>& labels);

/// Puts the seeds of people to the heads that the network sees elsewhere on their bodies; where
/// another segment begins at that head, theirs is a part of it, too. Returns whether there were
/// any.
bool put_seeds_to_heads(const PosesInDepths& poses, const SplitBodyParams& params,
                        std::vector<Segment>& segments, std::vector<std::int16_t>& labels);

}  // namespace limbcast::segmenter
