#include "modules/segmenter/seeds/skin_seeds.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace limbcast::segmenter {
namespace {

/// Middle of the most common component of skin in Jones and Rehg 2002, Table 2; a blue wall.
constexpr Bgr kSkin{75, 98, 151}, kWall{190, 120, 60};
constexpr int kImageWidth = 64, kImageHeight = 48;

/// A blue wall 2 m away with skin-coloured squares of `side_px`, their corners at `corners`.
Cloud wall_with_skin(const std::vector<Eigen::Vector2i>& corners, int side_px) {
  Cloud cloud;
  cloud.camera = PinholeCamera{kImageWidth, kImageHeight, 50.0, 50.0, 31.5, 23.5};
  cloud.width = kImageWidth;
  cloud.height = kImageHeight;
  for (int v = 0; v < kImageHeight; ++v) {
    for (int u = 0; u < kImageWidth; ++u) {
      cloud.points_m.push_back(
          cloud.camera->back_project(static_cast<float>(u), static_cast<float>(v), 2.0F));
      bool skin = false;
      for (const Eigen::Vector2i& c : corners)
        skin |= u >= c.x() && v >= c.y() && u < c.x() + side_px && v < c.y() + side_px;
      cloud.colors.push_back(skin ? kSkin : kWall);
    }
  }
  return cloud;
}

std::vector<HeadCandidate> parts_of(const Cloud& cloud) {
  const Lattice lattice = thin(cloud, make_level_frame(cloud.stamp.gravity, std::nullopt), 1);
  return find_skin_parts(cloud, lattice, SkinColor(), {});
}

TEST(SkinColor, TellsSkinFromAWall) {
  const SkinColor skin;
  EXPECT_GT(skin.log_ratio(kSkin), 0.0F);
  EXPECT_LT(skin.log_ratio(kWall), 0.0F);
}

TEST(SkinSeeds, AreOneForEachConnectedPart) {
  // 6 pixels at 2 m are 24 cm.
  const auto parts = parts_of(wall_with_skin({{10, 10}, {40, 20}}, 6));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].kind, SeedKind::kSkin);
  EXPECT_NEAR(parts[0].u, 12, 1);
  EXPECT_NEAR(parts[1].v, 22, 1);
}

TEST(SkinSeeds, AreNoneOnWhatIsLargerThanAFace) {
  EXPECT_TRUE(parts_of(wall_with_skin({{10, 10}}, 20)).empty());
}

TEST(SkinSeeds, AreNoneInACloudWithoutColor) {
  Cloud cloud = wall_with_skin({{10, 10}}, 6);
  cloud.colors.clear();
  EXPECT_TRUE(parts_of(cloud).empty());
}

}  // namespace
}  // namespace limbcast::segmenter
