#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "common/camera/pinhole_camera.hpp"
#include "modules/simulate/motion.hpp"
#include "modules/simulate/postures.hpp"
#include "modules/simulate/scene.hpp"

namespace limbcast::simulate {

enum class SetKind { kPointing, kGeneral, kMulti, kNoHuman, kSequence };

struct ScenarioParams {
  SetKind set = SetKind::kGeneral;
  int min_persons = 0,
      max_persons = 0;  ///< 0 = as the set has it: one, in multi 2 to 5, in nohuman none
  double min_distance_m = 1.3, max_distance_m = 4.8;  ///< of people along the camera's axis
  double occluder_share = 0.2;  ///< of frames with something between camera and a person
  double street_share = 0.0;    ///< of frames that are in a street, not in a room
  double cut_share = 0.15;      ///< of people who may stand partly out of the image
  double head_above_share = 0;  ///< of people whose head is above the image, their chest in it
  double min_camera_height_m = 0.9, max_camera_height_m = 1.6;
  double pitch_down_deg = 0.0;                         ///< mean pitch of the camera
  double pitch_sigma_deg = 7.0, roll_sigma_deg = 1.0;  ///< of the camera
  MotionKind motion = MotionKind::kAny;                ///< of a sequence
  double frame_rate_hz = 10.0;                         ///< of a sequence
  std::string
      posture;  ///< of everybody in the general set, a name of natural_posture_names; empty = any
  BodyParams body;
  PointingParams pointing;
};

struct Person {
  BodyShape body;
  Posture posture;
  Place place;
  Skeleton skeleton;  ///< in the sensor's frame
  int surface = -1;   ///< index in World::surfaces
};

/// One frame's worth of world, in the sensor's frame (x right, y down, z forward).
struct Scenario {
  std::string name;
  std::int64_t utime = 0;
  World world;
  std::vector<Person> persons;
  Eigen::Vector3d down{0, 1, 0};
  double sensor_height_m = 1.2;
  double pitch_down_deg = 0.0;
  Eigen::Vector3f light{0, -1, 0};  ///< unit vector towards the light
};

/// Frame `index` of the set with this seed; each is independent of the others (a sequence: its
/// moments). `camera` tells what is in view.
Scenario draw_scenario(const ScenarioParams& params, const PinholeCamera& camera,
                       std::uint64_t seed, int index);

}  // namespace limbcast::simulate
