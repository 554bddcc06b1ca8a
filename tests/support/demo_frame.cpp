#include "tests/support/demo_frame.hpp"

#include <stdexcept>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "modules/reconstructor/stage.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

DemoFrame read_demo_frame() {
  reconstructor::Stage stage{reconstructor::StageOptions{}};
  lcm_io::LogReader log(repository_file("logs/demo.log"));
  DemoFrame frame;
  while (const auto event = log.next()) {
    if (event->channel == "STEREO_CALIBRATION") {
      stage.on_calibration(lcm_io::decode<stereo_calibration_t>(event->data));
    } else if (event->channel == "STEREO_IMAGES") {
      frame.images = lcm_io::from_message(lcm_io::decode<stereo_images_t>(event->data));
      frame.cloud = stage.find(frame.images.stamp.sensor)->reconstruct(frame.images);
    } else if (event->channel == "GROUND_TRUTH") {
      frame.truth = lcm_io::from_message(lcm_io::decode<body_poses_t>(event->data));
    }
    if (!frame.truth.persons.empty() && frame.truth.stamp.utime == frame.cloud.stamp.utime)
      return frame;
  }
  throw std::runtime_error("logs/demo.log holds no frame");
}

}  // namespace

const DemoFrame& demo_frame() {
  static const DemoFrame frame = read_demo_frame();
  return frame;
}

}  // namespace limbcast::test
