#pragma once

#include "modules/simulate/skeleton.hpp"

/// Postures that are drawn by name alone (see `natural_posture_names`).
namespace limbcast::simulate {

/// Bends from hips and waist, as to pick something up or to rise from a seat.
Posture bowing(Rng& rng, const BodyShape& body);

/// With both hands, at its sides or at its lower edge: a board, a poster, a crate.
Posture holding(Rng& rng, const BodyShape& body);

/// On both knees or on one, upright or sitting on the heels; arms as they are.
void kneel(Rng& rng, Posture& posture);

/// On the ground, legs stretched, drawn up or crossed; arms as they are.
void sit_on_floor(Rng& rng, Posture& posture);

}  // namespace limbcast::simulate
