#include <limbcast/body_poses_t.hpp>

#include "common/lcm_io/module.hpp"
#include "modules/segmenter/stage.hpp"

namespace limbcast::segmenter {
namespace {

void run(int argc, const char* const* argv) {
  StageOptions options;
  config::Section section("segmenter");
  declare(section, options);
  config::Parser parser("limbcast-segmenter",
                        "Finds the people in point clouds and cuts them out.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;

  // Loading the networks takes longest: a module that says it is there hears what is sent.
  const Stage stage(options);
  lcm_io::Module module("segmenter", parser.common());
  module.subscribe_frames<point_cloud_t>(
      options.point_cloud_channel, [&](const point_cloud_t& message) {
        module.publish_frame(options.segments_channel, stage.process(message));
      });
  module.keep_pace_with<body_poses_t>(options.body_poses_channel);
  module.give_way(1);
  module.run();
}

}  // namespace
}  // namespace limbcast::segmenter

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-segmenter",
                                       [&] { limbcast::segmenter::run(argc, argv); });
}
