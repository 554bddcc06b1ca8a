#pragma once

#include <optional>

#include "common/human_model/body_pose.hpp"
#include "modules/pose_fitter/refined/evidence.hpp"

namespace limbcast::pose_fitter::refined {

/// Turns a fitted body and what speaks for it into what is told: which joints, how surely, who
/// points where; nothing when it is no believable person. In the range image's frame.
std::optional<BodyPose> assess(const BodyState& body, const Evidence& evidence,
                               const Observation& observation);

}  // namespace limbcast::pose_fitter::refined
