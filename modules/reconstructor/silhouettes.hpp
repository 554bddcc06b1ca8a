#pragma once

#include <opencv2/core/mat.hpp>

namespace limbcast::reconstructor {

struct SilhouetteParams {
  /// Things that stand out from what is behind them by less keep their outline [px].
  float min_step_px = 1.5F;
  /// Widest seam that is taken off [px]: wider than half a census window, narrower than an arm at
  /// 3 m. With 10 px more seams go, and with them arms before walls of their colour.
  int max_seam_px = 6;
  /// Weakest edge that ends a thing [grey levels over 2 px, mean of the channels]: above the
  /// images' noise.
  float min_edge = 7.0F;
  /// The outermost edge of at least this share of the strongest one nearby is taken: stripes within
  /// a thing may be stronger than its outline.
  float min_edge_share = 0.3F;
  /// Difference in colour between a seam and what is outside, over that between the seam and what
  /// is inside, at most. 0.5 takes off more seams, and more arms before walls of their colour.
  float max_color_ratio = 0.25F;
  /// Holes up to this width are looked across for what is outside [px]; a hole within one surface
  /// is no outline.
  int max_hole_px = 36;
};

/// Takes off the seam by which things grow over what is behind them: a window beyond the outline
/// still sees the outline, and an even wall matches at any disparity. From each step of disparity
/// inwards, along rows and columns, up to the image's edge. `image` is the left one, 8-bit, BGR or
/// grey; 0 = no disparity.
void trim_silhouettes(const cv::Mat& image, const SilhouetteParams& params,
                      cv::Mat1f& disparity_px);

}  // namespace limbcast::reconstructor
