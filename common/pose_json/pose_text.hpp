#pragma once

#include <string>

#include "common/human_model/body_pose.hpp"

namespace limbcast::pose_json {

/// A line for each person, or one that says that nobody is there; each ends with a line break.
///
///     1775000000.200 s  person 0 at (-0.40, 0.10, 2.70) m, 14 of 16 joints, error 0.031, left arm
///     points to
///     (-0.03, -0.29, -0.96), sigma 2.1 degrees
std::string to_text(const BodyPoses& poses);

}  // namespace limbcast::pose_json
