#include "common/sources/pacer.hpp"

#include <algorithm>

namespace limbcast {
namespace {

/// A longer pause is a cut between two recordings; nobody wants to wait for it.
constexpr std::chrono::microseconds kLongestPause{5'000'000};

}  // namespace

Pacer::Clock::time_point Pacer::due(std::int64_t utime, Clock::time_point now) {
  if (!last_utime_) {
    last_due_ = now;
  } else {
    const std::chrono::microseconds recorded{std::max<std::int64_t>(0, utime - *last_utime_)};
    const std::chrono::duration<double> period{rate_hz_ > 0.0 ? 1.0 / rate_hz_ : 0.0};
    last_due_ += rate_hz_ > 0.0 ? std::chrono::duration_cast<Clock::duration>(period)
                                : std::min<Clock::duration>(recorded, kLongestPause);
    last_due_ = std::max(last_due_, now);
  }
  last_utime_ = utime;
  return last_due_;
}

}  // namespace limbcast
