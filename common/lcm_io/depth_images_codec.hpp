#pragma once

#include <limbcast/depth_images_t.hpp>

#include "common/camera/calibration.hpp"
#include "common/camera/images.hpp"

namespace limbcast::lcm_io {

/// Depth is coded as PNG (lossless), colour as JPEG.
depth_images_t to_message(const DepthImages& images, const DepthCalibration& calibration,
                          int jpeg_quality);

struct CalibratedDepthImages {
  DepthImages images;
  DepthCalibration calibration;
};
/// Throws MessageError unless depth is 16 bit, of the lens's size, and colour missing or of the
/// same size.
CalibratedDepthImages from_message(const depth_images_t& message);

}  // namespace limbcast::lcm_io
