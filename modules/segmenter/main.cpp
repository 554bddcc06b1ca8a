#include <limbcast/point_cloud_t.hpp>
#include <limbcast/segments_t.hpp>
#include <string>

#include "common/lcm_io/module.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/segments_codec.hpp"
#include "modules/segmenter/options.hpp"
#include "modules/segmenter/segmenter.hpp"

namespace limbcast::segmenter {
namespace {

void run(int argc, const char* const* argv) {
  SegmenterOptions options;
  std::string input = "POINT_CLOUD", output = "SEGMENTS";
  config::Section section("segmenter");
  declare(section, options);
  section.add("point-cloud-channel", input, "input: point clouds");
  section.add("segments-channel", output, "output: person candidates");
  config::Parser parser("limbcast-segmenter",
                        "Finds the people in point clouds and cuts them out.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;

  lcm_io::Module module("segmenter", parser.common());
  const Segmenter segmenter(to_params(options));
  module.subscribe_frames<point_cloud_t>(input, [&](const point_cloud_t& message) {
    module.publish_frame(output,
                         lcm_io::to_message(segmenter.segment(lcm_io::from_message(message))));
  });
  module.run();
}

}  // namespace
}  // namespace limbcast::segmenter

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-segmenter",
                                       [&] { limbcast::segmenter::run(argc, argv); });
}
