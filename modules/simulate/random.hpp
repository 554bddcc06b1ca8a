#pragma once

#include <cmath>
#include <cstdint>

namespace limbcast::simulate {

/// Random numbers that do not depend on the standard library (those of <random> do).
///
/// SplitMix64: Steele, Lea and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014.
///
/// Draw in statements of their own or within braces. C++ leaves open which argument of a call, and
/// which operand of a sum, is evaluated first: gcc begins on the right for x86-64, on the left for
/// arm64, and a seed would give another scene there.
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15ULL;
    return mix(state_);
  }
  /// Uniform in [low, high).
  double uniform(double low = 0.0, double high = 1.0) {
    return low + (high - low) * static_cast<double>(next() >> 11U) * 0x1.0p-53;
  }
  /// Near enough to standard normal for the noise of pixels, and ten times as fast: the sum of four
  /// uniform numbers, at most 3.46.
  float pixel_noise() {
    const std::uint64_t bits = next();
    const auto sum = static_cast<float>((bits & 0xFFFFU) + ((bits >> 16U) & 0xFFFFU) +
                                        ((bits >> 32U) & 0xFFFFU) + (bits >> 48U));
    return (sum / 65536.0F - 2.0F) * 1.7320508F;
  }
  /// Normal, by Box and Muller; draws beyond 3 sigma are drawn again, so that no body is a monster.
  double normal(double mean = 0.0, double sigma = 1.0) {
    constexpr double kTwoPi = 6.283185307179586;
    for (;;) {
      const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
      const double value = radius * std::cos(kTwoPi * uniform());
      if (std::abs(value) <= 3.0) return mean + sigma * value;
    }
  }
  bool chance(double probability) { return uniform() < probability; }
  /// Whole number in [0, count).
  int pick(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
  /// A generator of its own for the thing numbered `tag`, so that a draw more here moves nothing
  /// there.
  Rng derive(std::uint64_t tag) const {
    return Rng(mix(state_ ^ mix(tag + 0x632BE59BD9B4E019ULL)));
  }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
  }
  std::uint64_t state_;
};

}  // namespace limbcast::simulate
