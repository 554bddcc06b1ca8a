#include "common/sources/capture_time.hpp"

#include <ctime>

namespace limbcast {
namespace {

/// No frame waits longer in a driver's buffers than this.
constexpr std::int64_t kLargestAge_us = 2'000'000;

std::int64_t read_us(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000 + time.tv_nsec / 1000;
}

bool is_age(std::int64_t age_us) { return age_us >= 0 && age_us < kLargestAge_us; }

}  // namespace

Clocks read_clocks() { return {read_us(CLOCK_REALTIME), read_us(CLOCK_MONOTONIC)}; }

std::int64_t capture_utime(std::int64_t driver_us, const Clocks& now) {
  if (is_age(now.monotonic_us - driver_us)) return now.utime - (now.monotonic_us - driver_us);
  if (is_age(now.utime - driver_us)) return driver_us;
  return now.utime;
}

}  // namespace limbcast
