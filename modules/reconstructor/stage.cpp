#include "modules/reconstructor/stage.hpp"

#include <iomanip>
#include <sstream>
#include <utility>

#include "common/config/log.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/depth_images_codec.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"

namespace limbcast::reconstructor {
namespace {

/// Says so where less is searched than the near limit asks for.
void tell_nearest(const StereoReconstructor& reconstructor, const std::string& sensor,
                  const ReconstructorOptions& options) {
  if (reconstructor.nearest_m() <= options.near_limit_m) return;
  std::ostringstream text;
  text << "stereo camera '" << sensor << "': nothing nearer than " << std::fixed
       << std::setprecision(2) << reconstructor.nearest_m() << " m is seen, not near-limit-m ("
       << options.near_limit_m << "), as at most " << reconstructor.most_disparities()
       << " disparities are searched; a lower image-scale sees nearer";
  config::log(config::LogLevel::kInfo, text.str());
}

}  // namespace

void declare(config::Section& section, StageOptions& options) {
  declare(section, options.algorithm);
  section.add("stereo-images-channel", options.stereo_images_channel, "input: stereo pairs");
  section.add("stereo-calibration-channel", options.stereo_calibration_channel,
              "input: their calibration");
  section.add("depth-images-channel", options.depth_images_channel,
              "input: frames of a depth camera");
  section.add("point-cloud-channel", options.point_cloud_channel, "output: point clouds");
  section.add("segments-channel", options.segments_channel,
              "input: what is made of the clouds; no more are made than are taken");
}

void Stage::on_calibration(stereo_calibration_t message) {
  message.utime = 0;  // sent once a second, but the same
  std::vector<std::uint8_t> bytes(message.getEncodedSize());
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  const Camera* known = cameras_.find(message.sensor);
  if (known != nullptr && known->calibration == bytes) {
    cameras_.get(message.sensor);  // the one used last is kept longest
    return;
  }
  auto reconstructor = std::make_shared<const StereoReconstructor>(lcm_io::from_message(message),
                                                                   options_.algorithm);
  tell_nearest(*reconstructor, message.sensor, options_.algorithm);
  cameras_.get(message.sensor) = {std::move(bytes), std::move(reconstructor)};
}

std::shared_ptr<const StereoReconstructor> Stage::find(const std::string& sensor) const {
  const Camera* known = cameras_.find(sensor);
  return known == nullptr ? nullptr : known->reconstructor;
}

point_cloud_t Stage::process(const StereoReconstructor& reconstructor,
                             const stereo_images_t& images) {
  return lcm_io::to_message(reconstructor.reconstruct(lcm_io::from_message(images)));
}

point_cloud_t Stage::process(const depth_images_t& images) const {
  const auto [frame, calibration] = lcm_io::from_message(images);
  return lcm_io::to_message(DepthReconstructor(calibration, options_.algorithm).reconstruct(frame));
}

}  // namespace limbcast::reconstructor
