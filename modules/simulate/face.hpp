#pragma once

#include <Eigen/Core>

namespace limbcast::simulate {

/// Colour of a head's skin at `place`: eyes, brows, nostrils and lips, as far as a network for
/// faces needs them. The proportions are those of drawing and anthropometry (the eyes at half the
/// head's height, one eye's width between them).
///
/// `skin`, `brows`: colours, blue green red, 0 to 255. `place`: on the head in fractions of a mean
/// adult's stature, x own left, y up, z forward, from its centre. `footprint`: width of a pixel
/// there in the same fractions, over which edges are smoothed.
Eigen::Vector3f face_color(const Eigen::Vector3f& skin, const Eigen::Vector3f& brows,
                           const Eigen::Vector3f& place, float footprint);

}  // namespace limbcast::simulate
