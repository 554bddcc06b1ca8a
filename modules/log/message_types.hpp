#pragma once

#include <limbcast/stamp_t.hpp>
#include <optional>
#include <string>

#include "common/lcm_io/log_file.hpp"

namespace limbcast::logs {

/// What can be told of a message without knowing its channel.
struct MessageSummary {
  std::string type;       ///< "point_cloud_t", "LCM's self-test"; empty for another project's
  std::string malformed;  ///< why it cannot be decoded; empty where it can
  std::optional<stamp_t> stamp;  ///< of a message that belongs to a frame
};

/// Tells the type by the fingerprint that every LCM message begins with.
MessageSummary summarize(const lcm_io::LogEvent& event);

/// First eight bytes in hexadecimal, to tell foreign types apart.
std::string fingerprint_text(const lcm_io::LogEvent& event);

}  // namespace limbcast::logs
