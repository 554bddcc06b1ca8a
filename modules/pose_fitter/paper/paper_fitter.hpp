#pragma once

#include <optional>

#include "common/cloud/segment.hpp"
#include "common/human_model/body_pose.hpp"
#include "modules/pose_fitter/paper/paper_params.hpp"

namespace limbcast::pose_fitter {

/// Body pose of one segment by the paper's section III-C: every typical pose in every rotation is
/// fitted link by link (Algorithm 2), the valid one with the lowest error (Eq. 1) wins.
class PaperFitter {
 public:
  /// Throws InputError where a model file cannot be used.
  explicit PaperFitter(const PaperFitterParams& params = {});

  /// Nothing where no typical pose can be fitted in a valid way. The same input gives the same
  /// pose, whatever the number of threads.
  std::optional<BodyPose> fit(const Segment& segment, const Stamp& stamp) const;

  const HumanModel& model() const { return model_; }

 private:
  PaperFitterParams params_;
  HumanModel model_;
};

}  // namespace limbcast::pose_fitter
