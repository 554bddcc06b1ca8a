#include "common/lcm_io/quantization.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace limbcast::lcm_io {
namespace {

TEST(QuantizeDepths, RoundsStepsOfInverseDepthHalvesUp) {
  EXPECT_EQ(quantize_depths({2.0F, 4.0F, 8.0F}, 10.0),
            (std::vector<std::uint16_t>{5, 3, 1}));  // 5, 2.5 and 1.25 steps
}

TEST(QuantizeDepths, MakesHolesOfWhatNoCodeCanExpress) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
  // Nearest: 65535 of 65535.25 steps, none of 65538 or twice as many; farthest: 1 of 0.5 steps,
  // none of 0.25.
  EXPECT_EQ(quantize_depths({4.0F, 0.0F, -1.0F, kInfinity, kNoNumber}, 4.0 * 65535.25),
            (std::vector<std::uint16_t>{65535, 0, 0, 0, 0}));
  EXPECT_EQ(quantize_depths({1.0F, 0.5F}, 65538.0), (std::vector<std::uint16_t>{0, 0}));
  EXPECT_EQ(quantize_depths({2.0F, 4.0F}, 1.0), (std::vector<std::uint16_t>{1, 0}));
}

TEST(DequantizeDepths, KeepsHoles) {
  EXPECT_EQ(dequantize_depths({0, 5}, 10.0), (std::vector<float>{0.0F, 2.0F}));
}

}  // namespace
}  // namespace limbcast::lcm_io
