#pragma once

#include <cstdint>

namespace limbcast {

/// Now, by the clock that utime is told in and by the one that drivers stamp with [us].
struct Clocks {
  std::int64_t utime = 0;         ///< since the Unix epoch
  std::int64_t monotonic_us = 0;  ///< CLOCK_MONOTONIC
};
Clocks read_clocks();

/// Moment of capture of a frame that was read at `now`. `driver_us` is the driver's stamp; it may
/// be by either clock (V4L2 leaves that to the driver), or nonsense: then the moment of reading is
/// all that is known.
std::int64_t capture_utime(std::int64_t driver_us, const Clocks& now);

}  // namespace limbcast
