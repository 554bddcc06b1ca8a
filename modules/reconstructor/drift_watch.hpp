#pragma once

#include <future>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bounded_map.hpp"
#include "modules/reconstructor/drift.hpp"
#include "modules/reconstructor/reconstructor.hpp"

namespace limbcast::reconstructor {

/// Watches on the pairs that come in whether the calibrations of their cameras still fit. It
/// measures one pair a second, in a thread of its own, so that no frame waits for it.
class DriftWatch {
 public:
  /// A pair and the cloud that was made of it. A new reconstructor means a new calibration.
  void look_at(const std::shared_ptr<const StereoReconstructor>& reconstructor,
               const stereo_images_t& pair, const point_cloud_t& cloud);
  /// For the status: which camera's calibration is off and by how much; empty where none is.
  std::string warning() const;

 private:
  struct Camera {
    std::shared_ptr<const StereoReconstructor> reconstructor;
    DriftMonitor monitor;
  };
  struct Measurement {
    std::string sensor;
    std::shared_ptr<const StereoReconstructor> reconstructor;
    std::int64_t utime;
    std::vector<double> row_differences_px;
    std::optional<GroundLean> ground;
  };
  /// True while a pair is being measured.
  bool is_busy();

  BoundedMap<Camera> cameras_;  ///< by sensor
  std::future<Measurement> measurement_;
};

}  // namespace limbcast::reconstructor
