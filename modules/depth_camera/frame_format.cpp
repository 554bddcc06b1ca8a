#include "modules/depth_camera/frame_format.hpp"

namespace limbcast::depth_camera {

PairFormat frame_format(const DepthCalibration& calibration) {
  PairFormat format;
  format.names = {"color", "depth"};
  format.second_is_depth = true;
  format.first_is_optional = true;
  format.width = calibration.color.camera.width;
  format.height = calibration.color.camera.height;
  if (calibration.depth_camera) {
    format.second_width = calibration.depth_camera->lens.camera.width;
    format.second_height = calibration.depth_camera->lens.camera.height;
  }
  return format;
}

}  // namespace limbcast::depth_camera
