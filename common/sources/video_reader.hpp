#pragma once

#include <limits>
#include <string>

#include "common/sources/live_capture.hpp"

namespace limbcast {

/// What to ask of a camera; what is 0 or NaN is left as the camera has it.
struct CameraSettings {
  int width = 0, height = 0;  ///< of the whole picture [px]
  double rate_hz = 0.0;
  double exposure =
      std::numeric_limits<double>::quiet_NaN();            ///< in the driver's unit (UVC: 100 us)
  double gain = std::numeric_limits<double>::quiet_NaN();  ///< in the driver's unit
  bool raw_depth = false;  ///< hand on 16-bit values as they come (V4L2 Z16)
};

/// Is it the name of a camera and no file: /dev/video0, gst:PIPELINE, rtsp://..., http://...?
bool is_camera(const std::string& source);

/// Opens a V4L2 device ("/dev/video0"), a GStreamer pipeline ("gst:v4l2src ! ...", a missing
/// appsink is added) or a network stream ("rtsp://..."). What the driver of a device refuses of the
/// settings is logged; pipelines and streams take none. Throws InputError naming what to do.
std::unique_ptr<FrameReader> open_camera(const std::string& source, const CameraSettings& settings);

/// For the log at start: driver's name, formats, sizes, exposure and gain of a V4L2 device; empty
/// for other cameras.
std::string camera_abilities(const std::string& source);

}  // namespace limbcast
