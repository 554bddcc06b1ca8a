#pragma once

#include <string>
#include <vector>

#include "modules/simulate/skeleton.hpp"

namespace limbcast::simulate {

/// Names of the natural postures: those that draw_natural draws, and "bow" (deeper than "lean"),
/// "kneel", "floor" (sitting on it) and "hold" (a board or a crate before the trunk or the face),
/// which are drawn by name alone: what earlier seeds draw stays as it is.
const std::vector<std::string>& natural_posture_names();

/// A natural posture by name, drawn with some freedom; an arm of it never goes through the body.
Posture draw_posture(Rng& rng, const BodyShape& body, const std::string& name);

/// Any natural posture, by how often people are seen so.
Posture draw_natural(Rng& rng, const BodyShape& body);

struct PointingParams {
  double min_elevation_deg = -30.0, max_elevation_deg = 40.0;  ///< against the horizon of the trunk
  double max_inward_deg = 35.0;                                ///< across the chest
  double max_outward_deg = 115.0;                              ///< sideways and a little back
  double max_bend_deg = 12.0;                                  ///< of the elbow
  double seated_share = 0.12;
};

/// One arm points somewhere, the other does something natural.
Posture draw_pointing(Rng& rng, const BodyShape& body, const PointingParams& params = {});

/// A step of walking; `phase_rad` grows by 2 pi for two steps.
Posture walking(const BodyShape& body, double phase_rad);

}  // namespace limbcast::simulate
