#include <limbcast/segments_t.hpp>
#include <utility>

#include "common/config/log.hpp"
#include "common/lcm_io/module.hpp"
#include "modules/reconstructor/calibration_wait.hpp"
#include "modules/reconstructor/drift_watch.hpp"
#include "modules/reconstructor/stage.hpp"

namespace limbcast::reconstructor {
namespace {

void run(int argc, const char* const* argv) {
  StageOptions options;
  config::Section section("reconstructor");
  declare(section, options);
  config::Parser parser("limbcast-reconstructor",
                        "Turns stereo pairs and depth images into coloured point clouds.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;

  lcm_io::Module module("reconstructor", parser.common());
  Stage stage(options);
  CalibrationWait wait;
  DriftWatch drift_watch;
  std::string drift;
  module.subscribe_all<stereo_calibration_t>(
      options.stereo_calibration_channel,
      [&](const stereo_calibration_t& message) { stage.on_calibration(message); });
  module.subscribe_frames<stereo_images_t>(
      options.stereo_images_channel, [&](const stereo_images_t& message) {
        const auto reconstructor = stage.find(message.stamp.sensor);
        if (reconstructor == nullptr) {
          if (wait.is_too_long(message.stamp.sensor, CalibrationWait::Clock::now()))
            module.report_problem("no calibration yet for stereo camera '" + message.stamp.sensor +
                                  "' on " + options.stereo_calibration_channel);
          return;
        }
        point_cloud_t cloud = Stage::process(*reconstructor, message);
        drift_watch.look_at(reconstructor, message, cloud);
        module.publish_frame(options.point_cloud_channel, std::move(cloud));
        const std::string drift_before = std::exchange(drift, drift_watch.warning());
        const std::string shared = stage.warning();
        module.set_note(shared.empty() || drift.empty() ? shared + drift : shared + "; " + drift);
        if (drift_before.empty() && !drift.empty()) config::log(config::LogLevel::kWarning, drift);
      });
  module.subscribe_frames<depth_images_t>(
      options.depth_images_channel, [&](const depth_images_t& message) {
        module.publish_frame(options.point_cloud_channel, stage.process(message));
      });
  module.keep_pace_with<segments_t>(options.segments_channel);
  module.give_way(2);
  module.run();
}

}  // namespace
}  // namespace limbcast::reconstructor

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-reconstructor",
                                       [&] { limbcast::reconstructor::run(argc, argv); });
}
