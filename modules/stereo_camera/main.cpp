#include <limbcast/stereo_images_t.hpp>

#include "common/camera/calibration_reader.hpp"
#include "common/camera/encoded_image.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/image_codec.hpp"
#include "common/lcm_io/stamp_codec.hpp"
#include "common/sources/log_playback.hpp"
#include "common/sources/source_process.hpp"
#include "modules/stereo_camera/swap_check.hpp"

namespace limbcast::stereo_camera {
namespace {

/// The order of the cameras does not change while the program runs.
constexpr std::int64_t kFramesToCheck = 3;

constexpr const char* kSecondKey = "source-right";

struct Options {
  SourceProcessOptions process;
  std::string images_channel = "STEREO_IMAGES";
  std::string calibration_channel = "STEREO_CALIBRATION";
};

void declare(config::Section& section, Options& options) {
  options.process.sensor = "stereo";
  limbcast::declare(section, options.process, kSecondKey);
  section.add_channel("images-channel", options.images_channel, "channel of the pairs");
  section.add_channel("calibration-channel", options.calibration_channel,
                      "channel of the calibration");
}

stereo_images_t to_message(const FramePair& frame) {
  stereo_images_t message{};
  message.stamp = lcm_io::to_message(frame.stamp);
  message.left = lcm_io::to_message(frame.first);
  message.right = lcm_io::to_message(frame.second);
  return message;
}

/// Says so where the pictures show that left and right are swapped.
class OrderCheck {
 public:
  explicit OrderCheck(const StereoCalibration& calibration) : calibration_(calibration) {}

  void look_at(const FramePair& frame, Outlet& outlet) {
    if (frame.stamp.sequence >= kFramesToCheck || told_) return;
    evidence_ += compare_blocks(decode_grey(frame.first, "left image"),
                                decode_grey(frame.second, "right image"), calibration_);
    told_ = looks_swapped(evidence_);
    if (!told_) return;
    outlet.report_problem("left and right images look swapped (" +
                          std::to_string(evidence_.behind_infinity) + " of " +
                          std::to_string(evidence_.blocks) +
                          " blocks stand behind infinity); swap the cameras or the files");
  }

 private:
  const StereoCalibration& calibration_;
  SwapEvidence evidence_;
  bool told_ = false;
};

void run(const Options& options, const config::CommonOptions& common) {
  if (is_lcm_log(options.process.source.source)) {
    play_log<stereo_images_t>(
        "stereo_camera", options.process, common,
        {options.images_channel, options.calibration_channel, options.process.truth_channel});
    return;
  }
  const StereoCalibration calibration = read_stereo_calibration(options.process.calibration);
  const std::string& sensor = options.process.sensor;
  const PairFormat format{{"left", "right"},
                          false,
                          calibration.left.camera.width,
                          calibration.left.camera.height,
                          sensor,
                          sensor + "/left_rectified",
                          options.process.source.jpeg_quality};
  std::optional<std::int64_t> calibration_sent_at;
  OrderCheck order(calibration);
  const auto send = [&](Outlet& outlet, const FramePair& frame) {
    const std::int64_t now = outlet.now(frame.stamp.utime);
    if (!calibration_sent_at ||
        now - *calibration_sent_at >= std::chrono::microseconds(kCalibrationPeriod).count()) {
      outlet.send(frame.stamp.utime, options.calibration_channel,
                  lcm_io::to_message(calibration, now, sensor));
      calibration_sent_at = now;
    }
    outlet.send_frame(options.images_channel, to_message(frame));
    order.look_at(frame, outlet);
  };
  run_source("stereo_camera", options.process, common, format, calibration.mounting, send);
}

}  // namespace
}  // namespace limbcast::stereo_camera

int main(int argc, char** argv) {
  using namespace limbcast;
  return config::run_program("limbcast-stereo-camera", [&] {
    stereo_camera::Options options;
    config::Section section("stereo_camera");
    stereo_camera::declare(section, options);
    config::Parser parser("limbcast-stereo-camera",
                          "publishes the pairs of a stereo camera, live or recorded");
    parser.add(section);
    if (!parser.parse(argc, argv)) return;
    require_input(options.process, "limbcast-stereo-camera");
    keep_camera_options_out(options.process.source, stereo_camera::kSecondKey, parser);
    keep_start_time_out(options.process.source, parser);
    stereo_camera::run(options, parser.common());
  });
}
