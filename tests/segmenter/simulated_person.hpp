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

}  // namespace limbcast::segmenter
