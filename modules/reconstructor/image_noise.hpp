#pragma once

#include <opencv2/core/mat.hpp>

namespace limbcast::reconstructor {

struct ImageNoiseParams {
  /// Noise that the matcher bears as it is [grey levels]: pairs of stereo_dev have 0.9 at most,
  /// simulated ones 1.2, a camera in a dim room 2 to 6.
  double max_noise = 1.3;
  /// With more, the images are blurred by base + rate * noise before their pixels are compared
  /// [px, px for a grey level], at most by the last [px]: of 0.6 to 1.6 px what gives the most
  /// joints at noises of 2.2 and 6 (tests/accuracy/README.md).
  double blur_base_px = 0.4, blur_rate_px = 0.1, max_blur_px = 1.2;
};

/// Standard deviation of an image's noise [grey levels], where it is largest: in the whole image or
/// in its darkest parts. From differences of second order, which see neither slopes nor edges
/// (Immerkaer, CVIU 64, 1996), and of these the low ones, so that texture counts little.
double noise_of(const cv::Mat1b& grey);

/// The images of a pair, alike, as blurred as their noise asks for; those without as they are.
struct QuietPair {
  cv::Mat1b left, right;
};
QuietPair quieted(const cv::Mat1b& left, const cv::Mat1b& right,
                  const ImageNoiseParams& params = {});

}  // namespace limbcast::reconstructor
