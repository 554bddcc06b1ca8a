#pragma once

#include "common/config/options.hpp"

namespace limbcast::reconstructor {

/// Options of the reconstructor, with their defaults.
struct ReconstructorOptions {
  /// Nearest depth; sets how many disparities may be searched. 0: what suits the sensor.
  double near_limit_m = 0.0;
  double far_limit_m = 12.0;  ///< points beyond are dropped
  double image_scale = 1.0;   ///< of the rectified images against the camera's, (0, 1]
  /// Region of interest in the rectified left image [px]; 0 = to the image's border.
  int roi_x = 0, roi_y = 0, roi_width = 0, roi_height = 0;
  bool ground_plane =
      true;  ///< find gravity and the sensor's height from the ground where nobody told them

  /// Of a stereo pair: somebody at a desk is 0.5 m away. Of a depth camera: what a RealSense D435
  /// sees.
  double stereo_near_limit_m() const { return near_limit_m > 0.0 ? near_limit_m : 0.4; }
  double depth_near_limit_m() const { return near_limit_m > 0.0 ? near_limit_m : 0.3; }
};

void declare(config::Section& section, ReconstructorOptions& options);
/// Throws UsageError where options do not fit together.
void check(const ReconstructorOptions& options);

}  // namespace limbcast::reconstructor
