#include "common/cloud/ground_plane.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace limbcast {
namespace {

using ::testing::MatchesRegex;
using ::testing::StartsWith;

/// What a camera at `height_m`, pitched down by `pitch_rad`, sees of a floor and a wall 5 m away;
/// with a table of 0.7 m if asked.
Cloud room(double height_m, double pitch_rad, bool with_floor = true, bool with_table = false) {
  Cloud cloud;
  const PinholeCamera camera{160, 120, 130.0, 130.0, 79.5, 59.5};
  cloud.camera = camera;
  cloud.width = camera.width;
  cloud.height = camera.height;
  const Eigen::Vector3f down(0.0F, std::cos(pitch_rad), std::sin(pitch_rad));
  const Eigen::Vector3f ahead(0.0F, -std::sin(pitch_rad), std::cos(pitch_rad));
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const Eigen::Vector3f ray = camera.back_project(u, v, 1.0F);
      float z_m = 5.0F / ahead.dot(ray);
      const float to_floor = static_cast<float>(height_m) / down.dot(ray);
      const float to_table = static_cast<float>(height_m - 0.7) / down.dot(ray);
      if (with_floor && to_floor > 0.0F) z_m = std::min(z_m, to_floor);
      if (with_table && to_table > 1.5F && to_table < 3.0F && std::abs(ray.x()) < 0.3F)
        z_m = std::min(z_m, to_table);
      cloud.points_m.push_back(camera.back_project(u, v, z_m));
    }
  }
  return cloud;
}

/// A scan of a street, 1.8 m below the scanner: `ground_share` of the points lie on the ground, all
/// else are walls, trees and cars above it. Farther than 10 m away it falls by one in ten.
Cloud street(double ground_share) {
  Cloud cloud;
  std::minstd_rand random(3);
  std::uniform_real_distribution<float> across_m(-20.0F, 20.0F), down_m(-4.0F, 1.5F), share;
  for (int i = 0; i < 20000; ++i) {
    Eigen::Vector3f point_m(across_m(random), down_m(random), across_m(random));
    if (share(random) < static_cast<float>(ground_share))
      point_m.y() = 1.8F + 0.1F * std::max(0.0F, std::hypot(point_m.x(), point_m.z()) - 10.0F);
    cloud.points_m.push_back(point_m);
  }
  return cloud;
}

TEST(GroundPlane, FindsFloorOfAPitchedCamera) {
  const auto ground = find_ground_plane(room(1.3, 0.35, true, true), {0.0F, 1.0F, 0.0F});
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->height_m, 1.3F, 0.005F);
  EXPECT_NEAR(std::atan2(ground->down.z(), ground->down.y()), 0.35, 0.003);
}

TEST(GroundPlane, OfAStreetThatFallsAwayIsTheOneNearby) {
  const auto ground = find_ground_plane(street(0.4), {0.0F, 1.0F, 0.0F});
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->height_m, 1.8F, 0.02F);
  EXPECT_GT(ground->down.y(), 0.999F);
}

TEST(GroundPlane, IsLookedForLongerWhereLittleOfItIsSeen) {
  const Cloud cloud = street(0.06);
  GroundPlaneParams no_longer;
  no_longer.hard_ransac_iterations = no_longer.ransac_iterations;
  ASSERT_FALSE(find_ground_plane(cloud, {0.0F, 1.0F, 0.0F}, no_longer));
  const auto ground = find_ground_plane(cloud, {0.0F, 1.0F, 0.0F});
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->height_m, 1.8F, 0.02F);
}

TEST(GroundPlane, FindsNoneOnAWall) {
  EXPECT_FALSE(find_ground_plane(room(1.3, 0.2, false), {0.0F, 1.0F, 0.0F}));
}

TEST(GroundPlane, FindsNoneInAnEmptyCloud) {
  EXPECT_FALSE(find_ground_plane(Cloud{}, {0.0F, 1.0F, 0.0F}));
}

TEST(CompleteGravity, TakesTheFloorWhereNobodyToldGravity) {
  Cloud cloud = room(1.1, 0.3);
  complete_gravity(cloud);
  EXPECT_EQ(cloud.stamp.gravity.source, GravitySource::kGroundPlane);
  EXPECT_NEAR(cloud.stamp.gravity.down.z(), std::sin(0.3F), 0.003F);
  ASSERT_TRUE(cloud.stamp.gravity.sensor_height_m);
  EXPECT_NEAR(*cloud.stamp.gravity.sensor_height_m, 1.1F, 0.01F);
}

TEST(GroundPlane, IsSurerTheMoreIsSeenOfIt) {
  const Cloud cloud = room(1.1, 0.3);
  const auto ground = find_ground_plane(cloud, {0.0F, 1.0F, 0.0F});
  ASSERT_TRUE(ground);
  EXPECT_GT(ground->confidence, 0.8F);
  EXPECT_LE(ground->confidence, 1.0F);
  // The same plane where just its share of the points is asked for only just passes.
  GroundPlaneParams only_just;
  only_just.min_inlier_share = ground->inlier_share;
  const auto barely = find_ground_plane(cloud, {0.0F, 1.0F, 0.0F}, only_just);
  ASSERT_TRUE(barely);
  EXPECT_NEAR(barely->confidence, 0.5F, 1e-3F);
}

TEST(DescribeGravity, SaysWhoToldItAndHowSureTheGroundIs) {
  Cloud cloud = room(1.1, 0.3);
  const auto ground = complete_gravity(cloud);
  ASSERT_TRUE(ground);
  EXPECT_THAT(describe(cloud.stamp.gravity, ground),
              MatchesRegex("gravity from the ground plane; ground 1\\.10 m below the sensor, "
                           "confidence 0\\.[5-9][0-9], [0-9]+ % of the points"));
  Gravity gravity;
  EXPECT_EQ(describe(gravity, std::nullopt), "gravity not told: the sensor is taken to be level");
  gravity.source = GravitySource::kRecording;
  EXPECT_EQ(describe(gravity, std::nullopt), "gravity from the recording");
  gravity.source = GravitySource::kOption;
  EXPECT_THAT(describe(gravity, ground), StartsWith("gravity from the option; ground 1.10 m"));
}

TEST(CompleteGravity, KeepsToldGravityAndAddsTheHeight) {
  Cloud cloud = room(1.1, 0.3);
  const Eigen::Vector3f told(0.0F, std::cos(0.31F), std::sin(0.31F));  // half a degree off
  cloud.stamp.gravity.down = told;
  cloud.stamp.gravity.source = GravitySource::kRecording;
  complete_gravity(cloud);
  EXPECT_EQ(cloud.stamp.gravity.source, GravitySource::kRecording);
  EXPECT_EQ(cloud.stamp.gravity.down, told);
  ASSERT_TRUE(cloud.stamp.gravity.sensor_height_m);
  EXPECT_NEAR(*cloud.stamp.gravity.sensor_height_m, 1.1F, 0.05F);
}

TEST(CompleteGravity, IsNotToldByANarrowShelf) {
  // A floor whose points beyond a strip of 0.5 m are not seen.
  Cloud cloud = room(0.5, 0.0);
  for (Eigen::Vector3f& point_m : cloud.points_m) {
    const bool beyond_strip = point_m.z() > 1.8F;
    if (beyond_strip) point_m.setZero();
  }
  const auto shelf = find_ground_plane(cloud, {0.0F, 1.0F, 0.0F});
  ASSERT_TRUE(shelf);  // its share of the points and its extent would do
  complete_gravity(cloud);
  EXPECT_EQ(cloud.stamp.gravity.source, GravitySource::kLevel);
  EXPECT_FALSE(cloud.stamp.gravity.sensor_height_m);

  cloud.stamp.gravity.source = GravitySource::kRecording;  // that is enough to tell a height
  complete_gravity(cloud);
  ASSERT_TRUE(cloud.stamp.gravity.sensor_height_m);
  EXPECT_NEAR(*cloud.stamp.gravity.sensor_height_m, 0.5F, 0.01F);
}

TEST(CompleteGravity, IsNotToldByATableWithThingsBelow) {
  Cloud table = room(1.1, 0.3);
  for (Eigen::Vector3f& point_m : table.points_m) {
    if (point_m.z() > 2.8F) point_m.setZero();
  }
  Cloud with_things_below = table;
  int seen = 0;
  for (Eigen::Vector3f& point_m : with_things_below.points_m) {
    if (point_m.z() > 0.0F && ++seen % 19 == 0) point_m = {0.1F, 2.0F, 2.0F};
  }
  complete_gravity(table);
  EXPECT_EQ(table.stamp.gravity.source, GravitySource::kGroundPlane);
  ASSERT_TRUE(find_ground_plane(with_things_below, {0.0F, 1.0F, 0.0F}));
  complete_gravity(with_things_below);
  EXPECT_EQ(with_things_below.stamp.gravity.source, GravitySource::kLevel);
}

TEST(CompleteGravity, StaysLevelWithoutGround) {
  Cloud cloud = room(1.1, 0.3, false);
  complete_gravity(cloud);
  EXPECT_EQ(cloud.stamp.gravity.source, GravitySource::kLevel);
  EXPECT_FALSE(cloud.stamp.gravity.sensor_height_m);
}

}  // namespace
}  // namespace limbcast
