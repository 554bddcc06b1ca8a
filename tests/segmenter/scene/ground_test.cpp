#include "modules/segmenter/scene/ground.hpp"

#include <gtest/gtest.h>

namespace limbcast::segmenter {
namespace {

constexpr float kHeight_m = 1.2F;
constexpr int kSide = 40;

/// A level rectangle under the sensor, and a wall behind it, which holds as many points.
Cloud level_rectangle(float width_m, float length_m) {
  Cloud cloud;
  cloud.width = kSide;
  cloud.height = 2 * kSide;
  constexpr float kNearest_m = 0.8F, kWall_m = 4.0F;
  for (int i = 0; i < kSide; ++i) {
    for (int k = 0; k < kSide; ++k) {
      const float across = static_cast<float>(i) / (kSide - 1) - 0.5F;
      const float along = static_cast<float>(k) / (kSide - 1);
      cloud.points_m.emplace_back(width_m * across, kHeight_m, kNearest_m + length_m * along);
      cloud.points_m.emplace_back(3.0F * across, 2.0F * along - 1.0F, kWall_m);
    }
  }
  return cloud;
}

TEST(GroundOfAScene, IsFoundWhereItIsInSight) {
  const auto ground = find_ground(level_rectangle(2.0F, 2.0F), {});
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->height_m, kHeight_m, 0.01F);
  EXPECT_NEAR(ground->down.y(), 1.0F, 1e-3F);
}

TEST(GroundOfAScene, IsNotTheLowerEndOfATrunk) {
  EXPECT_FALSE(find_ground(level_rectangle(0.4F, 0.15F), {}));
}

TEST(GroundOfAScene, MayBeANarrowStripWhereSomebodyToldTheSensorsHeight) {
  Cloud cloud = level_rectangle(1.2F, 0.3F);
  cloud.stamp.gravity.sensor_height_m = kHeight_m + 0.05F;
  const auto ground = find_ground(cloud, {});
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->height_m, kHeight_m, 0.01F);
}

}  // namespace
}  // namespace limbcast::segmenter
