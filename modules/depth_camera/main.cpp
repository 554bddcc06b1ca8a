#include <limbcast/depth_images_t.hpp>

#include "common/camera/calibration_reader.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/image_codec.hpp"
#include "common/lcm_io/stamp_codec.hpp"
#include "common/sources/log_playback.hpp"
#include "common/sources/source_process.hpp"
#include "modules/depth_camera/frame_format.hpp"
#include "modules/depth_camera/registration.hpp"

namespace limbcast::depth_camera {
namespace {

constexpr const char* kSecondKey = "source-depth";

struct Options {
  SourceProcessOptions process;
  std::string images_channel = "DEPTH_IMAGES";
};

void declare(config::Section& section, Options& options) {
  options.process.sensor = "depth";
  limbcast::declare(section, options.process, kSecondKey);
  section.add_channel("images-channel", options.images_channel, "channel of the frames");
}

/// `registration`: nothing where the depth is registered to the colour image already.
depth_images_t to_message(const FramePair& frame, const DepthCalibration& calibration,
                          const std::optional<DepthRegistration>& registration) {
  depth_images_t message{};
  message.stamp = lcm_io::to_message(frame.stamp);
  const bool depth_alone = frame.first.empty() && !registration;
  if (depth_alone) message.stamp.frame = frame.stamp.sensor + "/depth_optical";
  message.lens = lcm_io::to_message(calibration.color);
  message.depth_scale_m = calibration.depth_scale_m;
  message.mounting = lcm_io::to_message(calibration.mounting);
  message.color = lcm_io::to_message(frame.first);
  message.depth = lcm_io::to_message(
      registration
          ? encode_png(registration->registered(decode_image(frame.second, frame.second_name)))
          : frame.second);
  return message;
}

void run(const Options& options, const config::CommonOptions& common) {
  if (is_lcm_log(options.process.source.source)) {
    play_log<depth_images_t>("depth_camera", options.process, common,
                             {options.images_channel, "", options.process.truth_channel});
    return;
  }
  const DepthCalibration calibration = read_depth_calibration(options.process.calibration);
  PairFormat format = frame_format(calibration);
  format.sensor = options.process.sensor;
  format.frame = format.sensor + "/color_optical";
  format.jpeg_quality = options.process.source.jpeg_quality;
  std::optional<DepthRegistration> registration;
  if (calibration.depth_camera) registration.emplace(calibration);
  const auto send = [&](Outlet& outlet, const FramePair& frame) {
    outlet.send_frame(options.images_channel, to_message(frame, calibration, registration));
  };
  run_source("depth_camera", options.process, common, format, calibration.mounting, send);
}

}  // namespace
}  // namespace limbcast::depth_camera

int main(int argc, char** argv) {
  using namespace limbcast;
  return config::run_program("limbcast-depth-camera", [&] {
    depth_camera::Options options;
    config::Section section("depth_camera");
    depth_camera::declare(section, options);
    config::Parser parser("limbcast-depth-camera",
                          "publishes colour and depth of a depth camera, live or recorded");
    parser.add(section);
    if (!parser.parse(argc, argv)) return;
    require_input(options.process, "limbcast-depth-camera", /*second_will_do=*/true);
    keep_camera_options_out(options.process.source, depth_camera::kSecondKey, parser);
    keep_start_time_out(options.process.source, parser);
    depth_camera::run(options, parser.common());
  });
}
