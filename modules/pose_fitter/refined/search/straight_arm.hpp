#pragma once

#include <vector>

#include "modules/pose_fitter/refined/body_state.hpp"

namespace limbcast::pose_fitter::refined {

/// Arms that are raised point, mostly, and then they are straight: a bent arm that could as well be
/// straight and raised costs so much more. Of 12 arms whose cost differs by less 11 are straight,
/// of 18 that differ by twice as much 17 are bent (tests/accuracy/README.md).
inline constexpr Real kBentArmCost = 7.0;

/// The body with the arm of `side` straight from the shoulder along the line to the wrist, along
/// the upper arm, and along the forearm; empty where the arm is not bent.
std::vector<BodyState> with_straight_arm(const BodyState& body, int side);

bool is_straight_and_raised(const BodyState& body, int side);

}  // namespace limbcast::pose_fitter::refined
