#pragma once

#include <optional>

#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/module.hpp"

namespace limbcast::logs {

/// The next event; none when the program is told to end before the log's end, which
/// reader.at_end() tells: after its last event there is nothing left to interrupt.
inline std::optional<lcm_io::LogEvent> next_of(lcm_io::LogReader& reader) {
  std::optional<lcm_io::LogEvent> event = reader.next();
  return lcm_io::stop_requested() ? std::nullopt : event;
}

}  // namespace limbcast::logs
