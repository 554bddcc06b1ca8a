#include "common/lcm_io/module.hpp"
#include "modules/tracker/stage.hpp"

namespace limbcast::tracker {
namespace {

void run(int argc, const char* const* argv) {
  StageOptions options;
  config::Section section("tracker");
  declare(section, options);
  config::Parser parser("limbcast-tracker",
                        "Keeps the identity of people over time and smooths their poses.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;

  Stage stage(options);
  lcm_io::Module module("tracker", parser.common());
  module.subscribe_frames<body_poses_t>(options.body_poses_channel, [&](const body_poses_t& poses) {
    if (const auto tracked = stage.process(poses))
      module.publish_frame(options.tracked_poses_channel, *tracked);
    else
      module.report_problem(options.body_poses_channel + ": a frame of '" + poses.stamp.sensor +
                            "' came after a later one and was left out; was the clock set back?");
  });
  module.run();
}

}  // namespace
}  // namespace limbcast::tracker

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-tracker",
                                       [&] { limbcast::tracker::run(argc, argv); });
}
