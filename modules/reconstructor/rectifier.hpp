#pragma once

#include <opencv2/core/mat.hpp>

#include "common/camera/calibration.hpp"
#include "common/camera/lens_projection.hpp"

namespace limbcast::reconstructor {

/// A pair whose epipolar lines are the image rows, and both cameras' principal points the same.
struct RectifiedPair {
  cv::Mat left, right;
};

/// The rectification of the calibration, or the one that is computed (compute_rectification).
/// Throws std::invalid_argument, in one line, where the calibration is unusable, e.g. left and
/// right swapped.
Rectification usable_rectification(const StereoCalibration& calibration);

/// Turns the images of a calibrated pair so that corresponding points stand in the same row.
///
/// A pair that is rectified already is handed through without resampling.
class Rectifier {
 public:
  /// `image_scale` (0, 1]: the rectified images are this much smaller than the camera's.
  /// Throws as usable_rectification.
  explicit Rectifier(const StereoCalibration& calibration, double image_scale = 1.0);

  /// Throws std::invalid_argument where the images' size is not the calibration's.
  RectifiedPair rectify(const cv::Mat& left, const cv::Mat& right) const;

  /// The rectified left camera, whose frame all points are in.
  const PinholeCamera& camera() const { return camera_; }
  double baseline_m() const { return baseline_m_; }

 private:
  cv::Mat resample(const cv::Mat& image, const LensMaps& maps) const;

  PinholeCamera lens_left_, lens_right_, camera_;
  double baseline_m_ = 0.0;
  LensMaps left_maps_, right_maps_;  ///< empty: nothing to do
};

}  // namespace limbcast::reconstructor
