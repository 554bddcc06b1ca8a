#pragma once

#include <optional>
#include <vector>

#include "modules/pose_fitter/refined/body_state.hpp"
#include "modules/pose_fitter/refined/observation.hpp"

namespace limbcast::pose_fitter::refined {

/// The body as a network sees it: its joints on their rays, as far away as the person's own surface
/// is there, or else as the network's depths tell (MoveNet's: all as far as the hips). A
/// start for the solver, off by decimetres at hidden joints. Stature and girth are those of `like`.
/// Nothing where the network does not see shoulders and hips, or too little surface lies under its
/// joints.
std::optional<BodyState> body_in_image(const Observation& observation, const ImageLook& look,
                                       const BodyState& like);

/// The looks that a start is worth: the first, and each that sees another body than it does, as the
/// first is wrong then more often.
std::vector<const ImageLook*> looks_to_start_from(const Observation& observation);

}  // namespace limbcast::pose_fitter::refined
