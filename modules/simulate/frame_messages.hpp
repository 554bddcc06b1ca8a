#pragma once

#include <cstdint>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/depth_images_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <optional>
#include <string>

#include "common/sources/source_process.hpp"
#include "modules/simulate/simulator.hpp"

namespace limbcast::simulate {

struct Channels {
  std::string stereo_images = "STEREO_IMAGES";
  std::string stereo_calibration = "STEREO_CALIBRATION";
  std::string depth_images = "DEPTH_IMAGES";
  std::string point_cloud = "POINT_CLOUD";
  std::string truth = "GROUND_TRUTH";
};

/// The messages of one frame: those of the sensor that was simulated, and the truth.
class FrameMessages {
 public:
  /// `sensor`: name of the sensor in all messages.
  FrameMessages(const SimulatorParams& params, const SimulatedFrame& frame,
                const std::string& sensor, std::int64_t sequence);

  std::int64_t utime() const { return truth_.stamp.utime; }
  /// The frame becomes one of `utime`, the `sequence`th of its sensor.
  void restamp(std::int64_t utime, std::int64_t sequence);
  /// Sends all of it, a calibration before its pair.
  void send(const Channels& channels, Outlet& outlet) const;

 private:
  std::optional<stereo_images_t> stereo_;
  std::optional<stereo_calibration_t> calibration_;
  std::optional<depth_images_t> depth_;
  std::optional<point_cloud_t> cloud_;
  body_poses_t truth_{};
};

}  // namespace limbcast::simulate
