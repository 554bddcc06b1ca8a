#include "tests/benchmarks/demo_frame.hpp"

#include <stdexcept>

#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "modules/reconstructor/stage.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

DemoFrame read_demo_frame() {
  reconstructor::Stage stage{reconstructor::StageOptions{}};
  lcm_io::LogReader log(repository_file("logs/demo.log"));
  while (const auto event = log.next()) {
    const int size = static_cast<int>(event->data.size());
    if (event->channel == "STEREO_CALIBRATION") {
      stereo_calibration_t calibration;
      if (calibration.decode(event->data.data(), 0, size) == size)
        stage.on_calibration(calibration);
    } else if (event->channel == "STEREO_IMAGES") {
      stereo_images_t message;
      if (message.decode(event->data.data(), 0, size) != size) continue;
      const StereoImages images = lcm_io::from_message(message);
      return {images, stage.find(images.stamp.sensor)->reconstruct(images)};
    }
  }
  throw std::runtime_error("logs/demo.log holds no frame");
}

}  // namespace

const DemoFrame& demo_frame() {
  static const DemoFrame frame = read_demo_frame();
  return frame;
}

}  // namespace limbcast::test
