#pragma once

#include <istream>
#include <string>
#include <vector>

#include "common/human_model/body_pose.hpp"

namespace limbcast::pose_json {

/// One frame as one line of JSON without a line break:
/// {"utime":…,"persons":[{"id":…,"error":…,"confidence":…,"joints":{"head":[x,y,z],"wrist_left":null,…},
///   "joint_confidence":{…},"joint_sigma":{…},
///   "pointing":{"side":"left","direction":[…],"forearm":[…],"head_hand":[…],"sigma_deg":…,"confidence":…}}]}
///
/// Metres in the frame of the message, to 0.1 mm; `null` for a joint that was left out and where
/// nobody points; the most certain arm of several; the sensor's name follows utime.
std::string to_line(const BodyPoses& poses);

/// Reads such a line. Confidences and sigmas may be missing (0 then). `where` names file and line
/// in the InputError that a wrong line throws.
BodyPoses from_line(const std::string& line, const std::string& where);

/// All lines of a file; empty ones are passed over. What is thrown, for a file without any line
/// too, also says what to give instead.
std::vector<BodyPoses> read_lines(std::istream& in, const std::string& name);
std::vector<BodyPoses> read_file(const std::string& path);

}  // namespace limbcast::pose_json
