#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include "common/camera/calibration.hpp"

namespace limbcast::calibrate {

/// Where the images show what is before the cameras: 8 bit, 255 = there; of the images' size.
struct SeenAreas {
  cv::Mat left, right;
};

/// All of both images.
SeenAreas whole_images(const cv::Size& size);

struct SeenAreaParams {
  /// What is never brighter than this share of the brightest is dark. Beside the image circle of
  /// two real fisheyes (README, Handy_Calib_Images) stray light reaches a tenth.
  double dark_share = 0.125;
  /// Bright spots narrower than this share of the image's longer side tell nothing: noise, and
  /// reflections beside the image circle. Those of the same lenses are half as wide.
  double min_spot_share = 0.025;
};

/// Finds the part of the sensor that a fisheye lens lights: the smallest circle that holds all that
/// was ever bright. So a corner counts as dark only where the opposite ones are, too, and not where
/// the scene is dark there. Of pinholes all of the image.
class SeenAreaFinder {
 public:
  explicit SeenAreaFinder(const SeenAreaParams& params = {}) : params_(params) {}

  /// A pair, 8-bit grey; all of the same size.
  void add(const cv::Mat& left, const cv::Mat& right);
  /// By the pairs so far, of which there must be one.
  SeenAreas areas(LensModel model) const;

 private:
  cv::Mat lit_area(const cv::Mat& brightest) const;

  SeenAreaParams params_;
  cv::Mat left_, right_;  ///< the brightest that each pixel ever was
};

}  // namespace limbcast::calibrate
