#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>

#include "common/human_model/body_pose.hpp"

namespace limbcast::lcm_io {

/// What was found in a log besides sound messages.
struct PoseLogSummary {
  std::int64_t messages = 0;             ///< on the wanted channel and sound
  std::int64_t malformed = 0;            ///< on the wanted channel, dropped
  std::string first_problem;             ///< why the first of those was dropped
  std::int64_t torn_bytes = 0;           ///< after the last whole event: the log is torn
  std::set<std::string> other_channels;  ///< that carry poses, too
};

/// Calls `visit` for each body_poses_t of the log that came on `channel`, in order. Throws
/// config::UsageError where the log cannot be used.
PoseLogSummary visit_poses(const std::string& log, const std::string& channel,
                           const std::function<void(const BodyPoses&)>& visit);

/// Writes what a user should know about the log to stderr: torn, malformed messages.
void warn_about(const PoseLogSummary& summary, const std::string& log, const std::string& channel);

/// What is said of a log that has no poses on the channel: `others` have some.
std::string no_poses_on(const std::string& channel, const std::string& log,
                        const std::set<std::string>& others);

}  // namespace limbcast::lcm_io
