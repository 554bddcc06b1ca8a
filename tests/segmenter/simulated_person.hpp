#pragma once

#include <string>

#include "common/cloud/ground_plane.hpp"
#include "modules/simulate/simulator.hpp"

namespace limbcast::segmenter {

/// Of one adult in that posture, whole and in full sight, at a usual distance.
inline simulate::SimulatorParams person_in_sight(simulate::SensorKind sensor,
                                                 const std::string& posture) {
  simulate::SimulatorParams params;
  params.sensor = sensor;
  params.color = false;
  params.scenario.posture = posture;
  params.scenario.occluder_share = params.scenario.cut_share = 0.0;
  params.scenario.body.child_share = 0.0;
  params.scenario.min_distance_m = 2.4;
  params.scenario.max_distance_m = 3.6;
  return params;
}

/// Tells the cloud of a simulated frame where down is, and the ground.
inline void set_gravity(const simulate::SimulatedFrame& frame, Cloud& cloud) {
  cloud.stamp.gravity = {frame.told_down.cast<float>(), GravitySource::kRecording, std::nullopt};
  complete_gravity(cloud);
}

/// What a depth camera without colours measured.
inline Cloud depth_cloud(const simulate::SimulatorParams& params,
                         const simulate::SimulatedFrame& frame) {
  Cloud cloud;
  cloud.camera = params.camera;
  cloud.width = params.camera.width;
  cloud.height = params.camera.height;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u)
      cloud.points_m.push_back(params.camera.back_project(
          static_cast<float>(u), static_cast<float>(v), frame.sensed_depth_m.at<float>(v, u)));
  }
  set_gravity(frame, cloud);
  return cloud;
}

}  // namespace limbcast::segmenter
