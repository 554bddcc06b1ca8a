#pragma once

#include <memory>
#include <string>

#include "common/sources/camera_settings.hpp"
#include "common/sources/live_capture.hpp"

namespace limbcast {

/// Opens and starts a V4L2 device. Motion JPEG is handed on as it comes, and so is depth (Z16),
/// which neither OpenCV nor GStreamer read. What the driver refuses of the settings is logged.
/// Throws InputError naming what to do.
std::unique_ptr<FrameReader> open_v4l2(const std::string& path, const CameraSettings& settings);

}  // namespace limbcast
