#include "modules/simulate/simulator.hpp"

#include <opencv2/core.hpp>

#include "modules/simulate/render.hpp"

namespace limbcast::simulate {
namespace {

/// What random numbers are drawn for; the values keep each draw apart from the others.
enum Draw : std::uint64_t { kSensorDraw = 101, kNoiseDraw, kLeftDraw, kRightDraw, kGravityDraw };

Eigen::Vector3d told_down(const Eigen::Vector3d& down, double sigma_deg, Rng rng) {
  const double sigma = sigma_deg * 3.14159265358979 / 180.0;
  const double z = rng.normal();
  const double y = rng.normal();
  const double x = rng.normal();
  return (down + sigma * Eigen::Vector3d(x, y, z)).normalized();
}

void simulate_camera(const SimulatorParams& params, Rng& rng, SimulatedFrame& frame) {
  const World& world = frame.scenario.world;
  const HitImage hits = look(world, params.camera);
  frame.true_depth_m = depth_image(hits, params.camera);
  frame.mask = person_mask(world, hits);
  frame.labels = part_labels(world, hits);
  Rng sensor_rng = rng.derive(kSensorDraw);
  if (params.sensor == SensorKind::kDepth) {
    const DepthSensorParams sensor =
        params.vary_noise ? draw_depth_sensor(sensor_rng) : params.depth;
    frame.sensed_depth_m = sense_depth(frame.true_depth_m, facing_image(world, hits, params.camera),
                                       params.camera, sensor, rng.derive(kNoiseDraw));
  } else if (params.sensor == SensorKind::kStereoDepth) {
    StereoSensorParams sensor = params.vary_noise ? draw_stereo_sensor(sensor_rng) : params.stereo;
    sensor.baseline_m = params.baseline_m;
    frame.sensed_depth_m =
        sense_stereo(frame.true_depth_m, params.camera, sensor, rng.derive(kNoiseDraw));
  }
  if (params.sensor == SensorKind::kStereo || params.color) {
    frame.left = color_image(frame.scenario, hits, params.camera, rng.derive(kLeftDraw));
  }
  if (params.sensor == SensorKind::kStereo) {
    const Eigen::Vector3f right_eye(static_cast<float>(params.baseline_m), 0.0F, 0.0F);
    const HitImage right = look(world, params.camera, right_eye);
    frame.right =
        color_image(frame.scenario, right, params.camera, rng.derive(kRightDraw), {}, right_eye);
  }
  for (std::size_t i = 0; i < frame.scenario.persons.size(); ++i) {
    frame.pixels.push_back(cv::countNonZero(frame.mask == static_cast<int>(i) + 1));
  }
}

}  // namespace

StereoCalibration stereo_calibration(const SimulatorParams& params) {
  StereoCalibration calibration;
  calibration.left.camera = calibration.right.camera = params.camera;
  calibration.T.x() = -params.baseline_m;
  Rectification rectification;
  rectification.R1.setIdentity();
  rectification.R2.setIdentity();
  const PinholeCamera& camera = params.camera;
  rectification.P1 << camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0;
  rectification.P2 = rectification.P1;
  rectification.P2(0, 3) = -camera.fx * params.baseline_m;
  calibration.rectification = rectification;
  return calibration;
}

DepthCalibration depth_calibration(const SimulatorParams& params) {
  DepthCalibration calibration;
  calibration.color.camera = params.camera;
  return calibration;
}

SimulatedFrame simulate_frame(const SimulatorParams& params, std::uint64_t seed, int index) {
  SimulatedFrame frame;
  frame.scenario = draw_scenario(params.scenario, params.camera, seed, index);
  Rng rng = Rng(seed).derive(1'000'000 + static_cast<std::uint64_t>(index));
  frame.told_down =
      told_down(frame.scenario.down, params.gravity_sigma_deg, rng.derive(kGravityDraw));
  if (params.sensor != SensorKind::kLaser) {
    simulate_camera(params, rng, frame);
    return frame;
  }
  frame.laser = scan(frame.scenario.world, params.laser, rng.derive(kNoiseDraw));
  frame.pixels.assign(frame.scenario.persons.size(), 0);
  for (const int person : frame.laser.persons) {
    if (person > 0) ++frame.pixels[person - 1];
  }
  return frame;
}

}  // namespace limbcast::simulate
