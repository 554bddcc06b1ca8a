#pragma once

#include <optional>

#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/module.hpp"

namespace limbcast::logs {

/// The next event; none when the program is told to end, too.
inline std::optional<lcm_io::LogEvent> next_of(lcm_io::LogReader& reader) {
  return lcm_io::stop_requested() ? std::nullopt : reader.next();
}

}  // namespace limbcast::logs
