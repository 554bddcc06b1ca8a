#pragma once

#include <limbcast/body_poses_t.hpp>

#include "common/human_model/body_pose.hpp"

namespace limbcast::lcm_io {

body_poses_t to_message(const BodyPoses& poses);
/// Throws MessageError where a joint's name or a number is not what body_pose_t says.
BodyPoses from_message(const body_poses_t& message);

}  // namespace limbcast::lcm_io
