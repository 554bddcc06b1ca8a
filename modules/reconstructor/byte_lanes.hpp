#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "common/simd.hpp"

namespace limbcast::reconstructor {

/// A pixel's costs are as many bytes as fill vector registers: the number of disparities is rounded
/// up to a multiple of this, and what is beyond costs kNoMatch. Where registers are shorter than
/// this the compiler makes some vectors byte by byte.
#if defined(__aarch64__)
constexpr int kCostsInARegister = 16;
#else
constexpr int kCostsInARegister = 32;
#endif

/// Calls `loop` with the bytes of a pixel's costs; the usual ones as a constant, so that the
/// compiler unrolls the loops over them.
template <typename Loop>
LIMBCAST_INLINE inline void with_size(int num_registers, const Loop& loop) {
  constexpr int kFew = 64, kMany = 128;
  if (num_registers * kCostsInARegister == kFew)
    loop(std::integral_constant<int, kFew>());
  else if (num_registers * kCostsInARegister == kMany)
    loop(std::integral_constant<int, kMany>());
  else
    loop(num_registers * kCostsInARegister);
}

/// A register of bytes, for what the compiler does not vectorise well by itself. Never passed or
/// returned by value: how that is done depends on the processor.
using Lanes = std::uint8_t __attribute__((vector_size(kCostsInARegister)));

LIMBCAST_INLINE inline void lower_to(const Lanes& limits, Lanes& lanes) {
  lanes = lanes < limits ? lanes : limits;
}
/// As pairs of bytes, since of 16-bit numbers processors find the lowest by an instruction.
LIMBCAST_INLINE inline std::uint8_t lowest_of(const Lanes& lanes) {
  std::array<std::uint16_t, kCostsInARegister / 2> pairs{};
  std::memcpy(pairs.data(), &lanes, sizeof lanes);
  std::uint16_t lowest = 0xffff;
#pragma GCC unroll 1
  for (const std::uint16_t pair : pairs)
    lowest = std::min(lowest, static_cast<std::uint16_t>(std::min(pair & 0xff, pair >> 8)));
  return static_cast<std::uint8_t>(lowest);
}

}  // namespace limbcast::reconstructor
