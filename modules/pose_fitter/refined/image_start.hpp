#pragma once

#include <optional>

#include "modules/pose_fitter/refined/body_state.hpp"
#include "modules/pose_fitter/refined/observation.hpp"

namespace limbcast::pose_fitter::refined {

/// The body as the first network sees it: its joints on their rays, as far away as the person's own
/// surface is there, or else as the network's rough depths tell. A start for the solver, off by
/// decimetres at hidden joints. Stature and girth are those of `like`. Nothing where the network
/// does not see shoulders and hips, or too little surface lies under its joints.
std::optional<BodyState> body_in_image(const Observation& observation, const BodyState& like);

}  // namespace limbcast::pose_fitter::refined
