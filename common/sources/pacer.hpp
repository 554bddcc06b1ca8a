#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace limbcast {

/// Tells when the frames of a recording are due, so that they come as they once came.
class Pacer {
 public:
  using Clock = std::chrono::steady_clock;

  /// `rate_hz` > 0: this many frames a second; 0: as their utime says.
  explicit Pacer(double rate_hz) : rate_hz_(rate_hz) {}

  /// When the frame of `utime` is due; the first one at once. Call once for each frame, with the
  /// time now. A frame that is late does not make the next ones hurry.
  Clock::time_point due(std::int64_t utime, Clock::time_point now);

 private:
  double rate_hz_;
  std::optional<std::int64_t> last_utime_;
  Clock::time_point last_due_;
};

}  // namespace limbcast
