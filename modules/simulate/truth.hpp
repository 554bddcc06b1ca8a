#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/human_model/body_pose.hpp"
#include "modules/simulate/scenario.hpp"

namespace limbcast::simulate {

/// What a frame shows of a person.
struct Visibility {
  std::array<bool, kJointCount> joints{};
  bool head_top = false;
  std::array<bool, 2> hands{};
  double arm_fraction = 0.0;  ///< of the pointing arm, elbow to hand
};

/// Where the sensor can see: a pinhole camera, or (no width) all around.
using FieldOfView = PinholeCamera;

/// A joint is visible when it lies in the image, the ray to it meets the person's own skin at that
/// joint first, and no deeper before it than flesh and clothes are thick there. Own limbs in front
/// hide it too.
Visibility visibility_of(const Scenario& scenario, const Person& person, const FieldOfView& view);

/// The truth beside a frame, as data/README.md describes NAME_gt.json. `sensor` is what stands
/// under "camera" or "sensor". `pixels[i]`: how many pixels or points show person i.
nlohmann::json truth_json(const Scenario& scenario, const FieldOfView& view,
                          const std::vector<int>& pixels);

/// The same truth as it goes out on GROUND_TRUTH, with the conventions of read_ground_truth:
/// confidence is 1 where a joint or the pointing arm is visible, else 0.
BodyPoses truth_poses(const Scenario& scenario, const FieldOfView& view, const Stamp& stamp);

}  // namespace limbcast::simulate
