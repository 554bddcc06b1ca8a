#pragma once

namespace limbcast {

/// A head's centre behind the skin that the sensor sees, where a segment's seed is [m]
/// (data/README: 9 cm).
inline constexpr double kHeadBehindSeed_m = 0.09;

}  // namespace limbcast
