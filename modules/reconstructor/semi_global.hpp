#pragma once

#include <opencv2/core/mat.hpp>

#include "modules/reconstructor/even_background.hpp"

namespace limbcast::reconstructor {

/// Most disparities that can be searched.
constexpr int kMaxDisparities = 255;

/// Semi-global matching (Hirschmueller, IEEE PAMI 30, 2008) along four paths, from the left, the
/// right, above and below.
struct SemiGlobalParams {
  /// Disparities searched: 0 ... num_disparities - 1 [px].
  int num_disparities = 64;
  /// Cost of a step by one disparity between neighbours [census bits].
  int small_step_cost = 8;
  /// Cost of any larger step [census bits], where the image is even.
  int large_step_cost = 81;
  /// Where the brightness of neighbours differs by more than this [grey levels], a large step is
  /// cheaper in proportion: surfaces end where the image has an edge.
  int even_grey_levels = 4;
  EvenBackgroundParams even_background;
  /// Left-to-right and right-to-left disparities may differ by this much [px].
  int max_left_right_difference_px = 1;
};

/// Disparities of the left image [px], at least 1.5; 0 = none: where the right image's disparity
/// contradicts, or the match would lie outside. Their fractions are coarse: a parabola through the
/// costs. The result does not depend on the number of threads.
cv::Mat1f match_semi_global(const cv::Mat1b& left, const cv::Mat1b& right,
                            const SemiGlobalParams& params);

}  // namespace limbcast::reconstructor
