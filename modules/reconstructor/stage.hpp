#pragma once

#include <cstdint>
#include <limbcast/depth_images_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/bounded_map.hpp"
#include "common/config/options.hpp"
#include "modules/reconstructor/options.hpp"
#include "modules/reconstructor/reconstructor.hpp"

namespace limbcast::reconstructor {

struct StageOptions {
  ReconstructorOptions algorithm;
  std::string stereo_images_channel = "STEREO_IMAGES";
  std::string stereo_calibration_channel = "STEREO_CALIBRATION";
  std::string depth_images_channel = "DEPTH_IMAGES";
  std::string point_cloud_channel = "POINT_CLOUD";
  std::string segments_channel = "SEGMENTS";
};

/// Binds the keys of section [reconstructor].
void declare(config::Section& section, StageOptions& options);

/// From messages to messages: the one wiring of the reconstructor, for the process and for
/// limbcast-replay.
class Stage {
 public:
  /// Throws UsageError where options do not fit together.
  explicit Stage(const StageOptions& options);

  /// Makes the sensor's reconstructor anew where the calibration is another one than before. Throws
  /// MessageError or std::invalid_argument where it cannot be used.
  void on_calibration(stereo_calibration_t message);
  /// Names that two cameras seem to share, for the status; empty where none is.
  std::string warning() const;
  /// The reconstructor of that sensor; null as long as its calibration has not come. Several
  /// threads may use it, and it stays as it is when a new calibration comes.
  std::shared_ptr<const StereoReconstructor> find(const std::string& sensor) const;

  static point_cloud_t process(const StereoReconstructor& reconstructor,
                               const stereo_images_t& images);
  /// Several threads may call it.
  point_cloud_t process(const depth_images_t& images) const;

 private:
  struct Camera {
    std::vector<std::uint8_t> calibration, calibration_before;
    std::shared_ptr<const StereoReconstructor> reconstructor;
    /// Its calibration came back after another one.
    bool is_shared = false;
  };
  struct DepthCamera {
    std::vector<std::uint8_t> calibration;
    std::shared_ptr<const DepthReconstructor> reconstructor;
  };
  /// The sensor's, made anew where the calibration is another one than before. Each frame brings
  /// it, and the maps of a fisheye lens take 12 ms (VGA), of a pinhole 2.
  std::shared_ptr<const DepthReconstructor> depth_reconstructor(
      const depth_images_t& images, const DepthCalibration& calibration) const;

  StageOptions options_;
  BoundedMap<Camera> cameras_;  ///< by sensor
  mutable std::mutex depth_cameras_mutex_;
  mutable BoundedMap<DepthCamera> depth_cameras_;  ///< by sensor
};

}  // namespace limbcast::reconstructor
