#include "common/lcm_io/pose_log.hpp"

#include <limbcast/body_poses_t.hpp>

#include "common/config/log.hpp"
#include "common/joined.hpp"
#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/log_file.hpp"

namespace limbcast::lcm_io {

PoseLogSummary visit_poses(const std::string& log, const std::string& channel,
                           const std::function<void(const BodyPoses&)>& visit) {
  PoseLogSummary summary;
  LogReader reader(log);
  while (const auto event = reader.next()) {
    if (event->channel != channel) {
      if (fingerprint_of(event->data) == body_poses_t::getHash())
        summary.other_channels.insert(event->channel);
      continue;
    }
    BodyPoses poses;
    try {
      poses = from_message(decode<body_poses_t>(event->data));
    } catch (const MessageError& error) {
      if (summary.malformed++ == 0) summary.first_problem = error.what();
      continue;
    }
    ++summary.messages;
    visit(poses);
  }
  summary.torn_bytes = reader.torn_bytes();
  return summary;
}

void warn_about(const PoseLogSummary& summary, const std::string& log, const std::string& channel) {
  using config::LogLevel;
  if (summary.malformed > 0)
    config::log(LogLevel::kWarning, log + ": " + std::to_string(summary.malformed) +
                                        " malformed messages on " + channel +
                                        " dropped; the first: " + summary.first_problem);
  if (summary.torn_bytes > 0) config::log(LogLevel::kWarning, torn_end(log, summary.torn_bytes));
}

std::string no_poses_on(const std::string& channel, const std::string& log,
                        const std::set<std::string>& others) {
  const std::string remedy = "limbcast-replay adds them (tracked ones with --tracker)";
  return log + ": holds no poses on " + channel +
         (others.empty() ? "; " + remedy
                         : " but on " + joined(others) + "; choose such a channel, or " + remedy);
}

}  // namespace limbcast::lcm_io
