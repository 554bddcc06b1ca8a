#pragma once

#include <optional>

#include "common/cloud/segment.hpp"
#include "common/human_model/body_pose.hpp"
#include "modules/pose_fitter/refined/refined_params.hpp"

namespace limbcast::pose_fitter {

/// Fits an articulated body surface to a person candidate (README.md has the method). Holds no
/// state that changes: one object may serve many threads, and the same segment gives the same pose.
class RefinedFitter {
 public:
  explicit RefinedFitter(const RefinedParams& params = {}) : params_(params) {}

  /// The pose in the stamp's frame, or nothing where no believable person fits.
  std::optional<BodyPose> fit(const Segment& segment, const Stamp& stamp) const;

 private:
  RefinedParams params_;
};

}  // namespace limbcast::pose_fitter
