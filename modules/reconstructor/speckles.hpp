#pragma once

#include <opencv2/core/mat.hpp>

namespace limbcast::reconstructor {

struct SpeckleParams {
  /// Groups of at most so many pixels, cut off by steps in disparity, are removed [px].
  int max_size_px = 100;
  /// Step in disparity between neighbours that does not cut yet [px].
  float max_step_px = 2.1F;
};

/// Removes small groups of disparities (0 = none) as cv::filterSpeckles does, in a third of its
/// time: pieces of rows are joined, not pixels.
void remove_speckles(const SpeckleParams& params, cv::Mat1f& disparity_px);

}  // namespace limbcast::reconstructor
