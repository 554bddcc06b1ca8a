#pragma once

#include <opencv2/core/mat.hpp>

namespace limbcast::reconstructor {

struct GapParams {
  /// Longest gap that is filled [px]: longer than the holes that noise leaves, shorter than what a
  /// person hides of the background.
  int max_length_px = 4;
  /// Disparities on both sides of a gap in a surface differ by less [px].
  float same_surface_px = 1.5F;
};

/// Fills gaps of disparities (0 = none) in a row, then those left in a column, where both sides are
/// of one surface.
void fill_gaps(const GapParams& params, cv::Mat1f& disparity_px);

}  // namespace limbcast::reconstructor
