#pragma once

#include <cstdint>
#include <limbcast/module_status_t.hpp>
#include <optional>
#include <string>

namespace limbcast::lcm_io {

/// Whether an age of data [ms] tells how fast a module is. That of a recording that is played says
/// when it was made: a minute and more ago, or by another clock that far in the future.
bool is_age_of_live_data(float age_ms);

/// How a module fares, as it last told. Texts are safe to print: no control characters.
struct ModuleStatus {
  std::int64_t utime = 0;  ///< moment of sending by the module's clock [us]
  std::string module, host, version, state;
  int pid = 0;
  double rate_in_hz = 0.0, rate_out_hz = 0.0;
  std::optional<double> latency_p50_ms, latency_p99_ms;  ///< nothing: not told, or not of live data
  std::int64_t received = 0, published = 0;
  std::int64_t lost = 0, skipped = 0, malformed = 0;  ///< since the start of the module
  std::string last_error, note;
};

/// Throws MessageError for rates that are negative or not finite, negative counts, or a module
/// without a name.
ModuleStatus from_message(const module_status_t& message);

}  // namespace limbcast::lcm_io
