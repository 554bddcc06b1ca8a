#pragma once

#include <string>

#include "common/sources/camera_settings.hpp"
#include "common/sources/live_capture.hpp"

namespace limbcast {

/// Is it the name of a camera and no file: /dev/video0, gst:PIPELINE, rtsp://..., http://...?
bool is_camera(const std::string& source);

/// Opens a V4L2 device ("/dev/video0"), a GStreamer pipeline ("gst:v4l2src ! ...", a missing
/// appsink is added) or a network stream ("rtsp://..."). What the driver of a device refuses of the
/// settings is logged; pipelines and streams take none. Throws InputError naming what to do.
std::unique_ptr<FrameReader> open_camera(const std::string& source, const CameraSettings& settings);

/// Which of the settings are given that the driver of a device alone can do, by the names of their
/// options ("exposure, gain"); empty: none.
std::string driver_settings(const CameraSettings& settings);

/// For the log at start: what a V4L2 device can do (see v4l2_abilities); empty for other cameras.
std::string camera_abilities(const std::string& source);

}  // namespace limbcast
