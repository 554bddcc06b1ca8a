#pragma once

#include <opencv2/core/mat.hpp>

#include "common/camera/calibration.hpp"
#include "common/camera/lens_projection.hpp"
#include "common/cloud/cloud.hpp"

namespace limbcast::reconstructor {

struct DepthToCloudParams {
  /// Points outside are dropped [m].
  double near_limit_m = 0.3;
  double far_limit_m = 12.0;
  /// Standard deviation of a depth: constant_m + quadratic_per_m * z^2. RealSense D435:
  /// planes through windows of rgbd_pointing leave 14 mm at 2 m and 18 mm at 3 m where the windows
  /// are 41 px wide (median), 4 and 7 mm where they are 9 px wide.
  double noise_constant_m = 0.002;
  double noise_quadratic_per_m = 0.0020;
  /// A pixel is flying, between two surfaces, where the surface is steeper than this on both sides,
  /// in metres of depth a metre across: to the left and right, where walls end at 75 degrees, and
  /// up and down, where a floor far away is steep too; 0 keeps all.
  double max_slope_across = 3.5;
  double max_slope_upwards = 8.0;
  /// How far to both sides the slope is measured [m]: skirts of a RealSense D435 are 6 cm wide.
  double flying_window_m = 0.015;
};

/// Makes organised clouds, in the colour camera's frame, of one camera's images.
class DepthToCloud {
 public:
  /// What depends on the lens alone is computed here, once for all frames.
  explicit DepthToCloud(const DepthCalibration& calibration, const DepthToCloudParams& params = {});

  /// `depth` is 16-bit and registered to `color` (8-bit BGR or grey, or empty), 0 = hole. Fills
  /// points, colours, camera and depth noise. Throws std::invalid_argument where sizes or types do
  /// not fit.
  Cloud cloud_of(const cv::Mat& depth, const cv::Mat& color) const;

 private:
  struct Images {
    cv::Mat depth, color;
  };
  Images undistort(const Images& images) const;

  PinholeCamera camera_;
  double depth_scale_m_;
  DepthToCloudParams params_;
  /// From the image without distortion to the lens', for colours and to whole pixels for depths;
  /// empty where the lens has none.
  LensMaps color_maps_;
  cv::Mat depth_map_;
};

}  // namespace limbcast::reconstructor
