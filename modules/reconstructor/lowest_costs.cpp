#include "modules/reconstructor/lowest_costs.hpp"

#include <algorithm>
#include <cstddef>

#include "common/simd.hpp"
#include "modules/reconstructor/byte_lanes.hpp"

namespace limbcast::reconstructor {
namespace {

using Byte = std::uint8_t;

LIMBCAST_SIMD void find_lowest(int width, int num_registers, const Byte* __restrict costs,
                               const Byte* __restrict unsearched, Byte* __restrict disparities) {
  with_size(num_registers, [&](auto size) LIMBCAST_INLINE {
    for (int u = 0; u < width; ++u, costs += size) {
      std::uint16_t lowest = 0xffff;  // cost * 256 + disparity
      for (int d = 0; d < size; ++d) {
        const auto key = static_cast<std::uint16_t>((costs[d] | unsearched[d]) << 8 | d);
        lowest = std::min(lowest, key);
      }
      disparities[u] = static_cast<Byte>(lowest & 0xff);
    }
  });
}

/// Pixels of the right image are side by side in the lanes: what they see are diagonals through the
/// costs.
LIMBCAST_SIMD void find_lowest_of_right(int width, std::ptrdiff_t size, const Byte* costs,
                                        const Byte* unsearched, int num_disparities,
                                        Byte* disparities_mirrored) {
  for (int mirrored = 0; mirrored < width; mirrored += kCostsInARegister) {
    const int x = width - 1 - mirrored;  // of the first lane; the others' lie left of it
    const int begin = std::max(x - kCostsInARegister + 1, 0);
    const int end = std::min(x + num_disparities, width);
    Lanes disparity{}, found{}, lowest = ~found;
    for (int i = 0; i < kCostsInARegister; ++i) disparity[i] = static_cast<Byte>(begin - x + i);
    for (int u = begin; u < end; ++u, disparity += 1) {
      Lanes cost, is_unsearched;
      load(costs + u * size + (u - x), cost);
      load(unsearched + (u - x), is_unsearched);
      cost |= is_unsearched;
      const auto lower = reinterpret_cast<Lanes>(cost < lowest);
      lowest = cost < lowest ? cost : lowest;
      const Lanes candidate = disparity & lower;  // disparities grow, so the latest is the largest
      found = candidate > found ? candidate : found;
    }
    store(found, disparities_mirrored + mirrored);
  }
}

}  // namespace

LowestCosts::LowestCosts(int width, int size, int num_disparities)
    : width_(width),
      size_(size),
      num_disparities_(num_disparities),
      unsearched_(size + 2 * kCostsInARegister, 255) {
  std::fill_n(unsearched_.begin() + kCostsInARegister, num_disparities, Byte{0});
}

void LowestCosts::find_left(const Byte* costs, Byte* disparities) const {
  find_lowest(width_, size_ / kCostsInARegister, costs, unsearched_.data() + kCostsInARegister,
              disparities);
}

void LowestCosts::find_right(const Byte* costs, Byte* disparities_mirrored) const {
  find_lowest_of_right(width_, size_, costs, unsearched_.data() + kCostsInARegister,
                       num_disparities_, disparities_mirrored);
}

}  // namespace limbcast::reconstructor
