#pragma once

#include <optional>

#include "common/cloud/segment.hpp"
#include "common/human_model/human_model.hpp"
#include "modules/pose_fitter/company.hpp"
#include "modules/pose_fitter/refined/refined_params.hpp"

namespace limbcast::pose_fitter {

/// Fits an articulated body surface to a person candidate (README.md has the method). Holds no
/// state that changes: one object may serve many threads, and the same segment gives the same pose.
class RefinedFitter {
 public:
  explicit RefinedFitter(const RefinedParams& params = {});

  /// A person in the stamp's frame, or nothing where no believable person fits.
  std::optional<PersonCandidate> fit(const Segment& segment, const Stamp& stamp) const;

 private:
  RefinedParams params_;
  HumanModel model_;  ///< says what a pose's links and angles are
};

}  // namespace limbcast::pose_fitter
