#include "modules/reconstructor/lowest_costs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "modules/reconstructor/byte_lanes.hpp"

namespace limbcast::reconstructor {
namespace {

constexpr int kRowWidth = 70;

/// Costs of a row in which equal ones are frequent, with the room that is read beyond both ends.
std::vector<std::uint8_t> random_costs(int size) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> cost(0, 20);
  std::vector<std::uint8_t> costs(kRowWidth * size + 2 * kCostsInARegister);
  for (auto& byte : costs) byte = static_cast<std::uint8_t>(cost(random));
  return costs;
}

/// The first of the lowest of num_disparities costs `step` apart.
int first_lowest(const std::uint8_t* costs, int step, int num_disparities) {
  int lowest = 0;
  for (int d = 1; d < num_disparities; ++d)
    if (costs[d * step] < costs[lowest * step]) lowest = d;
  return lowest;
}

TEST(LowestCosts, AreFoundForBothImagesPixels) {
  for (const int num_disparities : {20, 40, 64, 100, 255}) {
    const int size =
        (num_disparities + kCostsInARegister - 1) / kCostsInARegister * kCostsInARegister;
    const std::vector<std::uint8_t> room = random_costs(size);
    const std::uint8_t* costs = room.data() + kCostsInARegister;
    std::vector<std::uint8_t> left(kRowWidth), right_mirrored(kRowWidth + kCostsInARegister);
    const LowestCosts lowest(kRowWidth, size, num_disparities);
    lowest.find_left(costs, left.data());
    lowest.find_right(costs, right_mirrored.data());
    for (int u = 0; u < kRowWidth; ++u) {
      const std::uint8_t* here = costs + u * size;
      EXPECT_EQ(left[u], first_lowest(here, 1, num_disparities));
      EXPECT_EQ(right_mirrored[kRowWidth - 1 - u],
                first_lowest(here, size + 1, std::min(num_disparities, kRowWidth - u)));
    }
  }
}

}  // namespace
}  // namespace limbcast::reconstructor
