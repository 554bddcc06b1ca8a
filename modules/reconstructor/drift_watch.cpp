#include "modules/reconstructor/drift_watch.hpp"

#include <chrono>
#include <cmath>

#include "common/formatted.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "modules/reconstructor/colors.hpp"
#include "modules/reconstructor/row_differences.hpp"

namespace limbcast::reconstructor {
namespace {

std::vector<double> measured_rows_px(const StereoReconstructor& reconstructor,
                                     const StereoImages& images) {
  return row_differences_px(
      reconstructor.rectifier().rectify(grey_of(images.left), grey_of(images.right)));
}

std::optional<GroundLean> measured_lean(const StereoReconstructor& reconstructor,
                                        const point_cloud_t& cloud) {
  return ground_lean(lcm_io::from_message(cloud), reconstructor.focal_baseline_px_m());
}

std::string row_warning(const std::string& sensor, double drift_px) {
  return formatted(
      "the calibration of '%s' has drifted: the rows of the two images differ by %.1f px and are "
      "aligned in each pair; measure it with limbcast-calibrate check and calibrate again",
      sensor.c_str(), drift_px);
}

std::string lean_warning(const std::string& sensor, const GroundLean& ground) {
  return formatted(
      "the ground before '%s' leans by %.1f degrees against gravity as it is told: the right "
      "camera "
      "has turned, so that disparities are off by %.1f px and all distances are wrong, or the told "
      "gravity is; measure a known length with limbcast-calibrate check",
      sensor.c_str(), std::abs(ground.lean_deg), std::abs(ground.offset_px));
}

}  // namespace

void DriftWatch::look_at(const std::shared_ptr<const StereoReconstructor>& reconstructor,
                         const stereo_images_t& pair, const point_cloud_t& cloud) {
  Camera& camera = cameras_.get(pair.stamp.sensor);
  if (camera.reconstructor != reconstructor) camera = {reconstructor, DriftMonitor()};
  if (is_busy() || !camera.monitor.is_due(pair.stamp.utime)) return;
  measurement_ = std::async(std::launch::async, [reconstructor, pair, cloud] {
    return Measurement{pair.stamp.sensor, reconstructor, pair.stamp.utime,
                       measured_rows_px(*reconstructor, lcm_io::from_message(pair)),
                       measured_lean(*reconstructor, cloud)};
  });
}

bool DriftWatch::is_busy() {
  if (!measurement_.valid()) return false;
  if (measurement_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return true;
  Measurement done = measurement_.get();
  Camera& camera = cameras_.get(done.sensor);
  if (camera.reconstructor == done.reconstructor)
    camera.monitor.add(done.utime, std::move(done.row_differences_px), done.ground);
  return false;
}

std::string DriftWatch::warning() const {
  std::string text;
  const auto tell = [&text](const std::string& warning) {
    text.append(text.empty() ? "" : "; ").append(warning);
  };
  cameras_.for_each([&tell](const std::string& sensor, const Camera& camera) {
    if (const auto drift_px = camera.monitor.drift_px()) tell(row_warning(sensor, *drift_px));
    if (const auto ground = camera.monitor.lean()) tell(lean_warning(sensor, *ground));
  });
  return text;
}

}  // namespace limbcast::reconstructor
