#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/camera/calibration.hpp"
#include "modules/simulate/depth_sensor.hpp"
#include "modules/simulate/laser.hpp"
#include "modules/simulate/scenario.hpp"

namespace limbcast::simulate {

enum class SensorKind {
  kStereo,       ///< a pair of pictures
  kStereoDepth,  ///< the depth that matching would give, without the pair
  kDepth,        ///< a depth camera
  kLaser,        ///< a laser range finder
};

struct SimulatorParams {
  ScenarioParams scenario;
  SensorKind sensor = SensorKind::kStereo;
  PinholeCamera camera{640, 480, 520.6, 520.6, 320.4, 238.7};  ///< that of data/stereo_dev
  double baseline_m = 0.12;
  bool vary_noise = true;  ///< another sensor with every frame; else the one below
  bool color = true;       ///< pictures for depth cameras; they cost as much time as the depth
  bool blind = false;      ///< no truth images (mask, true depth, labels) beside the frames
  DepthSensorParams depth;
  StereoSensorParams stereo;
  LaserParams laser;
  double gravity_sigma_deg = 0.35;  ///< of the told gravity, about each axis: about 0.5 in all
};

/// What the simulated camera would be calibrated to.
StereoCalibration stereo_calibration(const SimulatorParams& params);
DepthCalibration depth_calibration(const SimulatorParams& params);

/// All that one frame holds; what the sensor does not give is empty.
struct SimulatedFrame {
  Scenario scenario;
  Eigen::Vector3d told_down{0, 1, 0};  ///< gravity as an inertial unit would tell it
  cv::Mat left, right;                 ///< 8-bit BGR; a depth camera's picture is `left`
  cv::Mat sensed_depth_m;              ///< 32-bit float, 0 = hole
  cv::Mat true_depth_m, mask, labels;  ///< of the left camera
  LaserScan laser;
  std::vector<int> pixels;  ///< pixels or points that show each person
};

/// Frame `index` of the simulation; the same for the same parameters, seed and index, whatever the
/// number of threads and whichever frames were made before.
SimulatedFrame simulate_frame(const SimulatorParams& params, std::uint64_t seed, int index);

}  // namespace limbcast::simulate
