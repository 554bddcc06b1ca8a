#pragma once

#include <functional>
#include <string>

#include "modules/simulate/skeleton.hpp"

/// What postures are put together from.
namespace limbcast::simulate {

void stand(Rng& rng, Posture& posture);
void sit(Rng& rng, Posture& posture);

/// A little lean, twist and turn of the head, added to what the posture has.
void move_trunk(Rng& rng, Posture& posture);

/// Smallest distance [m] between the middle of an arm's forearm and hand and the rest of the body's
/// skin (negative: inside).
double arm_clearance_m(const BodyShape& body, const Posture& posture, Side side);

/// Draws an arm until it goes through nothing; after 30 draws the best so far. Its clearance [m].
double set_clear_arm(const BodyShape& body, Side side, Posture& posture,
                     const std::function<ArmPose()>& draw);

/// The arm does what `name` says (see `draw_arm`); it hangs where that goes through the body.
void set_arm(Rng& rng, const BodyShape& body, const std::string& name, Side side, Posture& posture);

}  // namespace limbcast::simulate
