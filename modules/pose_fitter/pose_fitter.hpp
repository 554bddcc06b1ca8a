#pragma once

#include <functional>
#include <optional>

#include "common/cloud/segment.hpp"
#include "common/human_model/body_pose.hpp"
#include "modules/pose_fitter/company.hpp"
#include "modules/pose_fitter/options.hpp"

namespace limbcast::pose_fitter {

/// Poses of all people in a frame, by the method that the options choose.
class PoseFitter {
 public:
  /// Throws InputError where a model file cannot be used.
  explicit PoseFitter(const PoseFitterOptions& options = {});

  /// One pose for each valid segment in which a person was found, in the order of segments; none
  /// twice. Segments are fitted in parallel; the result does not depend on the number of threads.
  BodyPoses fit(const Segments& segments) const;

 private:
  std::function<std::optional<PersonCandidate>(const Segment&, const Stamp&)> fit_one_;
};

}  // namespace limbcast::pose_fitter
