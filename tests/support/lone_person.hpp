#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "modules/simulate/body_surface.hpp"
#include "modules/simulate/scenario.hpp"

namespace limbcast::test {

/// Somebody with short hair and nothing on it before a level sensor.
struct LonePerson {
  double yaw_rad = 0.0;  ///< 0: faces the sensor
  /// Outward, up, forward; of both arms.
  Eigen::Vector3d arms = Eigen::Vector3d::UnitX();
  double distance_m = 3.0;
  double sensor_height_m = 1.2;
  std::uint64_t seed = 11;  ///< of the body
};

/// A scene of that person and nothing else.
inline simulate::Scenario scenario_of(const LonePerson& lone) {
  simulate::Rng rng(lone.seed);
  simulate::Person person;
  person.body = simulate::draw_body(rng);
  person.body.clothes.hair = simulate::Hair::kShort;
  person.body.clothes.hat = simulate::Hat::kNone;
  for (simulate::ArmPose& arm : person.posture.arms) arm.upper = arm.fore = lone.arms;
  person.place = {0.0, lone.distance_m, lone.yaw_rad};
  Eigen::Isometry3d sensor_from_world = Eigen::Isometry3d::Identity();
  sensor_from_world.linear() = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  sensor_from_world.translation().y() = lone.sensor_height_m;
  person.skeleton = simulate::transformed(
      simulate::make_skeleton(person.body, person.posture, person.place), sensor_from_world);
  person.surface = 0;
  simulate::Scenario scenario;
  scenario.world.surfaces.push_back(
      simulate::make_body_surface(person.body, person.posture, person.skeleton, 1));
  scenario.persons.push_back(person);
  return scenario;
}

}  // namespace limbcast::test
