#pragma once

#include <vector>

#include "modules/reconstructor/rectifier.hpp"

namespace limbcast::reconstructor {

struct RowDifferenceParams {
  /// Corners (Shi and Tomasi 1994) looked for in the left image; a VGA room shows some 250.
  int max_corners = 300;
  /// Weakest corner as a share of the strongest one's least eigenvalue, and the distance between
  /// two [px]; by eye on stereo_dev: corners all over the image, few of them noise.
  double min_quality = 0.02, min_spacing_px = 10.0;
  /// A corner that is tracked into the right image and back must come to where it was [px].
  double max_return_px = 0.3;
  /// Larger row differences are wrong matches: a drift of 2 degrees gives 18 px at 520 px of focal
  /// length.
  double max_difference_px = 24.0;
};

/// Row in the right image minus row in the left one [px] of the corners that both images of a
/// rectified, 8-bit grey pair show, tracked from the left into the right image (Lucas and Kanade
/// 1981). With a calibration that fits they scatter about 0.
std::vector<double> row_differences_px(const RectifiedPair& pair,
                                       const RowDifferenceParams& params = {});

/// Median of the sizes of row differences, which must not be empty: the size also shows a camera
/// that rolled, whose differences on the left are the opposite of those on the right.
double median_size_px(std::vector<double> differences_px);

}  // namespace limbcast::reconstructor
