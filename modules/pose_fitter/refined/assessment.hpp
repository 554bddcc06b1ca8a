#pragma once

#include <optional>
#include <vector>

#include "common/human_model/body_pose.hpp"
#include "modules/pose_fitter/refined/pose_search.hpp"

namespace limbcast::pose_fitter::refined {

/// Turns the candidates (best first) into what is told: which joints, how surely, who points where;
/// nothing when the best is no believable person. In the range image's frame.
std::optional<BodyPose> assess(const std::vector<PoseCandidate>& candidates, Solver& solver,
                               const FitStage& stage);

}  // namespace limbcast::pose_fitter::refined
