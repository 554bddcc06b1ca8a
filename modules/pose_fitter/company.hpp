#pragma once

#include <vector>

#include "common/human_model/body_pose.hpp"

namespace limbcast::pose_fitter {

/// Somebody who may be told of.
struct PersonCandidate {
  BodyPose pose;
  /// Too doubtful to be told alone, but not beside people who are sure.
  bool needs_company = false;
};

/// A person as sure as this is company. What looks like half a person in an empty room is furniture
/// as often as not; beside people, somebody who stands behind them: of 62 such bodies (simulated
/// groups before all sensors) 57 were people, and one of 940 frames with one person held one.
inline constexpr float kLeastCompanyConfidence = 0.9F;

/// Leaves out those who need company and have none. Keeps the order.
std::vector<BodyPose> leave_out_doubtful(std::vector<PersonCandidate> candidates);

}  // namespace limbcast::pose_fitter
