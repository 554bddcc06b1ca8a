#pragma once

#include <optional>

#include "common/cloud/cloud.hpp"

namespace limbcast::reconstructor {

/// How the ground that a stereo camera sees lies against gravity as it was told.
struct GroundLean {
  /// What all disparities would have to be too large by, as those of a right camera are that turned
  /// outwards about its upright axis [px].
  double offset_px = 0.0;
  double lean_deg = 0.0;  ///< the angle between ground and gravity that this stands for
};

/// Nothing where gravity was not told (it may be that of this very ground), where no ground is in
/// sight, or where the camera looks straight down and sees no horizon.
///
/// Of a plane n . X = h the disparities are f B / h (n . ray), so an offset of all of them adds
/// (0, 0, offset) to f B n / h: the ground seems to lean to the camera or away from it, by one
/// degree for 1 px at VGA, a baseline of 12 cm and 1.2 m over the ground.
std::optional<GroundLean> ground_lean(const Cloud& cloud, double focal_baseline_px_m);

}  // namespace limbcast::reconstructor
