#include <chrono>
#include <limbcast/depth_images_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <map>
#include <string>

#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/depth_images_codec.hpp"
#include "common/lcm_io/module.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "modules/reconstructor/reconstructor.hpp"

namespace limbcast::reconstructor {
namespace {

struct Channels {
  std::string stereo_images = "STEREO_IMAGES";
  std::string stereo_calibration = "STEREO_CALIBRATION";
  std::string depth_images = "DEPTH_IMAGES";
  std::string point_cloud = "POINT_CLOUD";
};

void declare(config::Section& section, Channels& channels) {
  section.add("stereo-images-channel", channels.stereo_images, "input: stereo pairs");
  section.add("stereo-calibration-channel", channels.stereo_calibration,
              "input: their calibration");
  section.add("depth-images-channel", channels.depth_images, "input: frames of a depth camera");
  section.add("point-cloud-channel", channels.point_cloud, "output: point clouds");
}

/// A reconstructor for each stereo camera, made again when its calibration changes.
class StereoCameras {
 public:
  explicit StereoCameras(const ReconstructorOptions& options) : options_(options) {}

  void on_calibration(stereo_calibration_t message) {
    message.utime = 0;  // sent once a second, but the same
    std::vector<std::uint8_t> bytes(message.getEncodedSize());
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    const auto known = cameras_.find(message.sensor);
    if (known != cameras_.end() && known->second.calibration == bytes) return;
    cameras_.insert_or_assign(
        message.sensor,
        Camera{bytes, StereoReconstructor(lcm_io::from_message(message), options_)});
  }

  const StereoReconstructor* find(const std::string& sensor) const {
    const auto known = cameras_.find(sensor);
    return known == cameras_.end() ? nullptr : &known->second.reconstructor;
  }

 private:
  struct Camera {
    std::vector<std::uint8_t> calibration;
    StereoReconstructor reconstructor;
  };
  ReconstructorOptions options_;
  std::map<std::string, Camera> cameras_;
};

void run(int argc, const char* const* argv) {
  ReconstructorOptions options;
  Channels channels;
  config::Section section("reconstructor");
  declare(section, options);
  declare(section, channels);
  config::Parser parser("limbcast-reconstructor",
                        "Turns stereo pairs and depth images into coloured point clouds.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;

  lcm_io::Module module("reconstructor", parser.common());
  StereoCameras cameras(options);
  module.subscribe_all<stereo_calibration_t>(
      channels.stereo_calibration,
      [&](const stereo_calibration_t& message) { cameras.on_calibration(message); });
  module.subscribe_frames<stereo_images_t>(
      channels.stereo_images, [&](const stereo_images_t& message) {
        const StereoReconstructor* reconstructor = cameras.find(message.stamp.sensor);
        if (reconstructor == nullptr) {
          module.report_problem("no calibration yet for stereo camera '" + message.stamp.sensor +
                                "' on " + channels.stereo_calibration);
          return;
        }
        const Cloud cloud = reconstructor->reconstruct(lcm_io::from_message(message));
        module.publish_frame(channels.point_cloud, lcm_io::to_message(cloud));
      });
  module.subscribe_frames<depth_images_t>(
      channels.depth_images, [&](const depth_images_t& message) {
        const auto [images, calibration] = lcm_io::from_message(message);
        const Cloud cloud = DepthReconstructor(calibration, options).reconstruct(images);
        module.publish_frame(channels.point_cloud, lcm_io::to_message(cloud));
      });
  module.run();
}

}  // namespace
}  // namespace limbcast::reconstructor

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-reconstructor",
                                       [&] { limbcast::reconstructor::run(argc, argv); });
}
