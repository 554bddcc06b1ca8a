#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/human_model/body_pose.hpp"
#include "modules/evaluate/matching.hpp"
#include "modules/pose_fitter/refined/fitted_body.hpp"
#include "modules/segmenter/segmenter.hpp"

namespace limbcast::pose_fitter {

/// A frame whose segments were fitted, beside its truth.
struct FittedFrame {
  Stamp stamp;
  std::vector<refined::FittedBody> bodies;
  std::vector<BodyPose> poses;  ///< all joints of each body
  std::vector<BodyPose> truth;
  evaluate::Matching matching;
};

/// Runs the chain on each labelled frame of a folder that shows neither body D4 nor D5 (they are
/// for checking) and calls `take(frame, number)` for each, in the frames' order. Every fourth is
/// seen without the image's networks, as by a sensor without colour, every eighth without that of
/// depths.
void fit_frames(const std::string& folder, const segmenter::Params& params,
                const std::function<void(FittedFrame&&, std::size_t)>& take);

/// Eight neighbouring frames go to one block; of four blocks the last tells how good a fit is.
bool is_checked_on(std::size_t frame);

}  // namespace limbcast::pose_fitter
