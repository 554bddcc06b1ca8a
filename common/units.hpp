#pragma once

namespace limbcast {

/// One unit in another, as the number that the code calculates with, e.g.
/// `kDegreesPerRadian<float>`.
template <class Number>
inline constexpr Number kPi = static_cast<Number>(3.14159265358979323846);
template <class Number>
inline constexpr Number kDegreesPerRadian = static_cast<Number>(57.29577951308232088);
template <class Number>
inline constexpr Number kMillimetersPerMeter = static_cast<Number>(1000);
template <class Number>
inline constexpr Number kMicrosecondsPerSecond = static_cast<Number>(1'000'000);

inline double radians(double degrees) { return degrees * kPi<double> / 180.0; }

}  // namespace limbcast
