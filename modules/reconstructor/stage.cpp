#include "modules/reconstructor/stage.hpp"

#include <iomanip>
#include <sstream>
#include <utility>

#include "common/config/log.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/depth_images_codec.hpp"
#include "common/lcm_io/encode.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"

namespace limbcast::reconstructor {
namespace {

/// Says so where the image is too narrow for what the near limit asks for.
void tell_nearest(const StereoReconstructor& reconstructor, const std::string& sensor,
                  const ReconstructorOptions& options) {
  if (reconstructor.nearest_m() <= options.stereo_near_limit_m()) return;
  std::ostringstream text;
  text << "stereo camera '" << sensor << "': nothing nearer than " << std::fixed
       << std::setprecision(2) << reconstructor.nearest_m() << " m is seen, not near-limit-m ("
       << options.stereo_near_limit_m() << "): farther to the left the right image ends";
  config::log(config::LogLevel::kInfo, text.str());
}

std::string shared_name_warning(const std::string& sensor) {
  return "two cameras are called '" + sensor +
         "': calibrations alternate, and pairs are matched with the other one's; give each its own "
         "--sensor";
}

/// What of a depth camera's message is the same in all its frames.
std::vector<std::uint8_t> calibration_bytes(const depth_images_t& images) {
  depth_images_t calibration{};
  calibration.lens = images.lens;
  calibration.depth_scale_m = images.depth_scale_m;
  calibration.mounting = images.mounting;
  return lcm_io::encode(calibration);
}

}  // namespace

Stage::Stage(const StageOptions& options) : options_(options) { check(options.algorithm); }

std::string Stage::warning() const {
  std::string text;
  cameras_.for_each([&text](const std::string& sensor, const Camera& camera) {
    if (!camera.is_shared) return;
    text.append(text.empty() ? "" : "; ").append(shared_name_warning(sensor));
  });
  return text;
}

void declare(config::Section& section, StageOptions& options) {
  declare(section, options.algorithm);
  section.add_input_channel("stereo-images-channel", options.stereo_images_channel, "stereo pairs");
  section.add_input_channel("stereo-calibration-channel", options.stereo_calibration_channel,
                            "their calibration");
  section.add_input_channel("depth-images-channel", options.depth_images_channel,
                            "frames of a depth camera");
  section.add_output_channel("point-cloud-channel", options.point_cloud_channel, "point clouds");
  section.add_input_channel("segments-channel", options.segments_channel,
                            "what is made of the clouds; no more are made than are taken");
}

void Stage::on_calibration(stereo_calibration_t message) {
  message.utime = 0;  // sent once a second, but the same
  std::vector<std::uint8_t> bytes = lcm_io::encode(message);
  const Camera* known = cameras_.find(message.sensor);
  if (known != nullptr && known->calibration == bytes) {
    cameras_.get(message.sensor);  // the one used last is kept longest
    return;
  }
  auto reconstructor = std::make_shared<const StereoReconstructor>(lcm_io::from_message(message),
                                                                   options_.algorithm);
  Camera& camera = cameras_.get(message.sensor);
  const bool was_shared = camera.is_shared;
  camera.is_shared = was_shared || bytes == camera.calibration_before;
  if (camera.is_shared && !was_shared)
    config::log(config::LogLevel::kWarning, shared_name_warning(message.sensor));
  if (!camera.is_shared) tell_nearest(*reconstructor, message.sensor, options_.algorithm);
  camera.calibration_before = std::exchange(camera.calibration, std::move(bytes));
  camera.reconstructor = std::move(reconstructor);
}

std::shared_ptr<const StereoReconstructor> Stage::find(const std::string& sensor) const {
  const Camera* known = cameras_.find(sensor);
  return known == nullptr ? nullptr : known->reconstructor;
}

point_cloud_t Stage::process(const StereoReconstructor& reconstructor,
                             const stereo_images_t& images) {
  return lcm_io::to_message(reconstructor.reconstruct(lcm_io::from_message(images)));
}

std::shared_ptr<const DepthReconstructor> Stage::depth_reconstructor(
    const depth_images_t& images, const DepthCalibration& calibration) const {
  const std::vector<std::uint8_t> bytes = calibration_bytes(images);
  const std::lock_guard lock(depth_cameras_mutex_);
  DepthCamera& camera = depth_cameras_.get(images.stamp.sensor);
  if (camera.reconstructor == nullptr || camera.calibration != bytes)
    camera = {bytes, std::make_shared<const DepthReconstructor>(calibration, options_.algorithm)};
  return camera.reconstructor;
}

point_cloud_t Stage::process(const depth_images_t& images) const {
  const auto [frame, calibration] = lcm_io::from_message(images);
  return lcm_io::to_message(depth_reconstructor(images, calibration)->reconstruct(frame));
}

}  // namespace limbcast::reconstructor
