#include "modules/reconstructor/drift_watch.hpp"

#include <chrono>

#include "common/formatted.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "modules/reconstructor/colors.hpp"
#include "modules/reconstructor/row_differences.hpp"

namespace limbcast::reconstructor {
namespace {

std::vector<double> measure(const StereoReconstructor& reconstructor, const stereo_images_t& pair) {
  const StereoImages images = lcm_io::from_message(pair);
  return row_differences_px(
      reconstructor.rectifier().rectify(grey_of(images.left), grey_of(images.right)));
}

}  // namespace

void DriftWatch::look_at(const std::shared_ptr<const StereoReconstructor>& reconstructor,
                         const stereo_images_t& pair) {
  Camera& camera = cameras_.get(pair.stamp.sensor);
  if (camera.reconstructor != reconstructor) camera = {reconstructor, DriftMonitor()};
  if (is_busy() || !camera.monitor.is_due(pair.stamp.utime)) return;
  measurement_ = std::async(std::launch::async, [reconstructor, pair] {
    return Measurement{pair.stamp.sensor, reconstructor, pair.stamp.utime,
                       measure(*reconstructor, pair)};
  });
}

bool DriftWatch::is_busy() {
  if (!measurement_.valid()) return false;
  if (measurement_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return true;
  Measurement done = measurement_.get();
  Camera& camera = cameras_.get(done.sensor);
  if (camera.reconstructor == done.reconstructor)
    camera.monitor.add(done.utime, std::move(done.row_differences_px));
  return false;
}

std::string DriftWatch::warning() const {
  std::string text;
  cameras_.for_each([&text](const std::string& sensor, const Camera& camera) {
    const std::optional<double> drift_px = camera.monitor.drift_px();
    if (!drift_px) return;
    text.append(text.empty() ? "" : "; ");
    text.append(formatted(
        "the calibration of '%s' has drifted: the rows of the two images differ by %.1f px and are "
        "aligned in each pair; measure it with limbcast-calibrate check and calibrate again",
        sensor.c_str(), *drift_px));
  });
  return text;
}

}  // namespace limbcast::reconstructor
