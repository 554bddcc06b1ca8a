#pragma once

#include <string>
#include <vector>

#include "common/human_model/body_pose.hpp"

namespace limbcast::replay {

/// How far poses may be from the recorded ones: another compiler or processor rounds differently.
struct Tolerance {
  float joint_m = 0.005F;
  float direction_deg = 0.5F;
};

/// A line for each difference: frames and persons that are there on one side only, joints and
/// directions that came, went or moved by more than the tolerance. Empty where both say the same.
std::vector<std::string> pose_differences(const std::vector<BodyPoses>& before,
                                          const std::vector<BodyPoses>& after,
                                          const Tolerance& tolerance = {});

}  // namespace limbcast::replay
