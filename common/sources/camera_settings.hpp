#pragma once

#include <limits>
#include <string>

namespace limbcast {

/// What to ask of a camera; what is 0, empty or NaN is left to the program or the camera.
struct CameraSettings {
  int width = 0, height = 0;  ///< of the whole picture [px]; 0: the calibration's
  /// What `width` and `height` are where they are 0 [px]: the calibration's; 0: the camera's own.
  int calibrated_width = 0, calibrated_height = 0;
  double rate_hz = 0.0;  ///< 0: kUsualRate_hz, or the next that the camera has
  std::string format;    ///< V4L2's four letters, "YUYV", "MJPG"; empty: see choose_format
  double exposure =
      std::numeric_limits<double>::quiet_NaN();            ///< in the driver's unit (UVC: 100 us)
  double gain = std::numeric_limits<double>::quiet_NaN();  ///< in the driver's unit
  bool raw_depth = false;  ///< hand on 16-bit values as they come (V4L2 Z16)
};

/// Frames a second that nearly every camera has.
inline constexpr double kUsualRate_hz = 30.0;

}  // namespace limbcast
