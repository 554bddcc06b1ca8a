#pragma once

#include <functional>
#include <string>

#include "common/camera/calibration.hpp"
#include "common/camera/images.hpp"
#include "common/sources/open_source.hpp"

namespace limbcast::calibrate {

/// Whether a folder (NAME_depth without NAME_left) or an LCM log (DEPTH_IMAGES) is a depth
/// camera's.
bool is_of_depth_camera(const std::string& source);

/// Calls `take` with each frame of a depth camera, registered to the colour image, from a folder
/// (NAME_color, NAME_depth), an LCM log, a video or cameras, until the source ends or `take`
/// returns false. Throws InputError where the source cannot be used, std::runtime_error where the
/// program is told to end.
void visit_depth_frames(const SourceOptions& options, const DepthCalibration& calibration,
                        const std::function<bool(const DepthImages&)>& take);

/// The calibration of `path`; without a path the one that an LCM log carries. Throws InputError
/// where there is none.
DepthCalibration find_depth_calibration(const std::string& path, const std::string& source);

}  // namespace limbcast::calibrate
