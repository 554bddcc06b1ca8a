#pragma once

#include <opencv2/core/mat.hpp>

namespace limbcast::reconstructor {

struct SubpixelParams {
  /// Pixels whose disparities differ by less are one surface [px].
  float same_surface_px = 0.965F;
  /// Blur of the images before they are interpolated [px], against their noise.
  double blur_px = 0.7;
  /// Variance of brightness in a window [grey levels^2] at which its own shift and none weigh the
  /// same: that of the images' noise.
  float noise_variance = 0.37F;
  /// Where one image is brighter by more than this share, as cameras are that expose each for
  /// itself, the other is made as bright.
  double most_brightness_difference = 0.05;
};

/// Finds the fractions of disparities [px, 0 = none] anew: the right image, warped by the smoothed
/// disparities, is shifted window by window to where it fits the left one best (one step of Lucas
/// and Kanade, with a free difference in brightness). What comes out does not favour whole
/// disparities, since it starts from averages over a surface, not from one pixel's costs.
void refine_disparities(const cv::Mat1b& left, const cv::Mat1b& right, const SubpixelParams& params,
                        cv::Mat1f& disparity_px);

}  // namespace limbcast::reconstructor
