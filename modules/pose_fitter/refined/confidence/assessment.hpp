#pragma once

#include <optional>

#include "modules/pose_fitter/company.hpp"
#include "modules/pose_fitter/pointing.hpp"
#include "modules/pose_fitter/refined/fitted_body.hpp"

namespace limbcast::pose_fitter::refined {

/// In the truth, arms that point bend by less than 15 degrees and are raised by more than 60; those
/// up to 35 hang. Half way, with room for measuring errors.
inline constexpr PointingParams kPointingRule{/*max_elbow_bend_deg=*/45.0, /*min_raise_deg=*/45.0};

/// Turns a fitted body and what speaks for it into what is told: which joints, how surely, who
/// points where; nothing when it is no believable person. In the range image's frame.
std::optional<PersonCandidate> assess(const FittedBody& fitted);

}  // namespace limbcast::pose_fitter::refined
