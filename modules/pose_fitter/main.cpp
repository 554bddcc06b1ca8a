#include "common/lcm_io/module.hpp"
#include "modules/pose_fitter/stage.hpp"

namespace limbcast::pose_fitter {
namespace {

void run(int argc, const char* const* argv) {
  StageOptions options;
  config::Section section("pose_fitter");
  declare(section, options);
  config::Parser parser("limbcast-pose-fitter", "Fits a human body into each person candidate.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;

  const Stage stage(options);
  lcm_io::Module module("pose_fitter", parser.common());
  module.subscribe_frames<segments_t>(options.segments_channel, [&](const segments_t& message) {
    module.publish_frame(options.body_poses_channel, stage.process(message));
  });
  module.run();
}

}  // namespace
}  // namespace limbcast::pose_fitter

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-pose-fitter",
                                       [&] { limbcast::pose_fitter::run(argc, argv); });
}
