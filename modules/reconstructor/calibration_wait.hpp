#pragma once

#include <chrono>
#include <string>

#include "common/bounded_map.hpp"

namespace limbcast::reconstructor {

/// A camera sends its calibration once a second: who starts beside a running one hears pairs first,
/// and nothing is wrong with that.
class CalibrationWait {
 public:
  using Clock = std::chrono::steady_clock;

  /// Three calibrations should have come since this sensor's first pair without any.
  bool is_too_long(const std::string& sensor, Clock::time_point now) {
    constexpr std::chrono::seconds kLongest{3};
    return now - first_pair_at_.get(sensor, now) > kLongest;
  }

 private:
  BoundedMap<Clock::time_point> first_pair_at_;
};

}  // namespace limbcast::reconstructor
