#include "common/lcm_io/depth_images_codec.hpp"

#include <cmath>

#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/image_codec.hpp"
#include "common/lcm_io/message_error.hpp"
#include "common/lcm_io/stamp_codec.hpp"

namespace limbcast::lcm_io {

depth_images_t to_message(const DepthImages& images, const DepthCalibration& calibration,
                          int jpeg_quality) {
  depth_images_t message{};
  message.stamp = to_message(images.stamp);
  message.lens = to_message(calibration.color);
  message.depth_scale_m = calibration.depth_scale_m;
  message.mounting = to_message(calibration.mounting);
  message.color = to_jpeg_message(images.color, jpeg_quality);
  message.depth = to_png_message(images.depth);
  return message;
}

CalibratedDepthImages from_message(const depth_images_t& message) {
  CalibratedDepthImages result;
  result.images.stamp = from_message(message.stamp);
  result.calibration.color = from_message(message.lens);
  result.calibration.depth_scale_m = message.depth_scale_m;
  require(std::isfinite(message.depth_scale_m) && message.depth_scale_m > 0.0,
          "depth images: 'depth_scale_m' is not positive");
  result.calibration.mounting = from_message(message.mounting);
  result.images.color = from_message(message.color);
  result.images.depth = from_message(message.depth);
  require(result.images.depth.type() == CV_16UC1, "depth images: depth is not 16 bit");
  const PinholeCamera& camera = result.calibration.color.camera;
  require(result.images.depth.cols == camera.width && result.images.depth.rows == camera.height,
          "depth images: size differs from the calibration's");
  require(
      result.images.color.empty() || (result.images.color.size() == result.images.depth.size() &&
                                      result.images.color.depth() == CV_8U),
      "depth images: colour is not 8 bit of the depth's size");
  return result;
}

}  // namespace limbcast::lcm_io
