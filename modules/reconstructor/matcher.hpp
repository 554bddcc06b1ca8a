#pragma once

#include <opencv2/core/mat.hpp>

#include "modules/reconstructor/disparity.hpp"

namespace limbcast::reconstructor {

/// Semi-global matching of a rectified pair (OpenCV's SGBM), unlocked and checked.
struct MatcherParams {
  /// Disparities searched: 0 ... num_disparities - 1 [px]. Rounded up to a multiple of 16.
  int num_disparities = 64;
  /// Side of the window whose pixels are compared [px, odd]: smaller keeps edges, larger quiets
  /// noise.
  int block_size = 3;
  /// Left-to-right and right-to-left disparities may differ by this much [px].
  double max_left_right_difference_px = 1.0;
  /// Groups of pixels smaller than this, cut off by steps in disparity, are removed [px].
  int speckle_size = 100;
  /// Step in disparity that cuts [px].
  double speckle_step_px = 2.0;
};

/// Disparities of the left image. Both images 8-bit, BGR or grey, of one size.
DisparityImage match(const cv::Mat& left, const cv::Mat& right, const MatcherParams& params = {});

}  // namespace limbcast::reconstructor
