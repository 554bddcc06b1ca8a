#pragma once

#include <memory>
#include <string>

#include "common/sources/live_capture.hpp"

namespace limbcast {

/// Starts a GStreamer pipeline, written as for gst-launch-1.0. Where it has no appsink one is added
/// that drops the oldest picture, and before it, but for raw depth, a conversion to BGR or grey.
/// Throws InputError with `name` and GStreamer's own reason; so does the reader when it fails
/// later.
std::unique_ptr<FrameReader> open_pipeline(const std::string& name, const std::string& pipeline,
                                           bool raw_depth);

}  // namespace limbcast
