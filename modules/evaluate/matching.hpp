#pragma once

#include <optional>
#include <vector>

#include "common/human_model/body_pose.hpp"

namespace limbcast::evaluate {

/// Mean distance of head, neck, chest and pelvis that both know, of all joints that both know where
/// these are none; nothing where they share no joint [m].
std::optional<float> person_distance_m(const BodyPose& a, const BodyPose& b);

enum class ReportKind {
  kMatched,   ///< the report of a true person
  kTwice,     ///< another report matches the true person beside it better
  kInvented,  ///< no true person is near
};

/// Which reported person is which true one.
struct Matching {
  std::vector<std::optional<std::size_t>> report_of_truth;
  std::vector<ReportKind> kinds;  ///< of each report
};

/// One to one, nearest pairs first, none farther than `max_distance_m`.
Matching match_persons(const std::vector<BodyPose>& truth, const std::vector<BodyPose>& reported,
                       float max_distance_m);

}  // namespace limbcast::evaluate
