#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/camera/calibration.hpp"
#include "common/cloud/cloud.hpp"

namespace limbcast::calibrate {

struct MountingParams {
  /// Frames that must show ground. One is enough where the camera stands still.
  int min_frames = 1;
  /// How far gravity [degrees] and height [m] of single frames may spread about their median: ten
  /// times the errors measured on a recording (README). Ramps or a robot that moves give more.
  double max_spread_deg = 2.0, max_spread_m = 0.1;
};

/// How the camera stands, from the ground plane in the clouds of a recording.
class MountingFinder {
 public:
  explicit MountingFinder(const MountingParams& params = {}) : params_(params) {}

  /// A cloud in the camera's frame, of which gravity is not known.
  void add(const Cloud& cloud);

  int frames() const { return frames_; }
  int frames_with_ground() const { return static_cast<int>(heights_m_.size()); }
  /// Medians of what the frames say. Throws std::runtime_error, saying why, where they do not agree
  /// or show no ground.
  Mounting mounting() const;

 private:
  MountingParams params_;
  int frames_ = 0;
  std::vector<Eigen::Vector3d> downs_;
  std::vector<double> heights_m_;
};

}  // namespace limbcast::calibrate
