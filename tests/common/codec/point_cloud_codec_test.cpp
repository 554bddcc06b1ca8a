#include "common/lcm_io/point_cloud_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/lcm_io/message_error.hpp"
#include "tests/common/codec/codec_values.hpp"

namespace limbcast::lcm_io {
namespace {

TEST(PointCloudCodec, RoundsDepthsTenTimesFinerThanTheNoise) {
  const Cloud cloud = camera_cloud();
  const Cloud back = from_message(to_message(cloud));
  ASSERT_EQ(back.points_m.size(), cloud.points_m.size());
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    ASSERT_EQ(back.is_hole(i), cloud.is_hole(i));
    if (cloud.is_hole(i)) continue;
    const float z_m = cloud.points_m[i].z();
    // Steps of sigma / 10, so at most half of one off.
    EXPECT_LE(std::abs(back.points_m[i].z() - z_m),
              0.051F * cloud.stamp.depth_noise.sigma_m(z_m) + 1e-6F);
  }
}

TEST(PointCloudCodec, ChangesNothingTheSecondTime) {
  const Cloud once = from_message(to_message(camera_cloud()));
  const Cloud twice = from_message(to_message(once));
  EXPECT_EQ(once.points_m, twice.points_m);
}

TEST(PointCloudCodec, CarriesListsWithColors) {
  Cloud cloud;
  cloud.stamp = test_stamp();
  cloud.points_m = {{1.0F, -2.0F, 3.0F}, {-20.5F, 0.0F, -7.125F}};
  cloud.colors = {{1, 2, 3}, {4, 5, 6}};
  cloud.width = 2;
  cloud.height = 1;
  const Cloud back = from_message(to_message(cloud));
  ASSERT_EQ(back.points_m.size(), 2U);
  EXPECT_FALSE(back.organized());
  EXPECT_LT((back.points_m[1] - cloud.points_m[1]).norm(), 0.001F);  // one millimetre steps
  EXPECT_EQ(back.colors[1].g, 5);
}

/// A list of four points with intensities and rings.
Cloud laser_cloud(const std::vector<float>& intensities) {
  Cloud cloud;
  cloud.stamp = test_stamp();
  cloud.points_m.assign(4, {1.0F, -2.0F, 3.0F});
  cloud.intensities = intensities;
  cloud.rings = {0, 127, 40'000, 65'535};
  cloud.width = 4;
  cloud.height = 1;
  return cloud;
}

TEST(PointCloudCodec, CarriesWholeIntensitiesAndRingsAsTheyAre) {
  const Cloud cloud = laser_cloud({0.0F, 255.0F, -7.0F, 32'767.0F});
  const Cloud back = from_message(to_message(cloud));
  EXPECT_EQ(back.intensities, cloud.intensities);
  EXPECT_EQ(back.rings, cloud.rings);
}

TEST(PointCloudCodec, RoundsOtherIntensitiesToAShareOfTheLargest) {
  for (const float largest : {1.0F, 70'000.0F}) {
    const Cloud cloud = laser_cloud({0.0F, 0.37F * largest, 0.01F * largest, largest});
    const Cloud back = from_message(to_message(cloud));
    ASSERT_EQ(back.intensities.size(), 4U);
    // Half a step of 32767 that the largest is divided in.
    const float tolerance = 0.51F / 32'767.0F * largest;
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(back.intensities[i], cloud.intensities[i], tolerance);
  }
}

TEST(PointCloudCodec, SendsNothingOfIntensitiesAndRingsThatASensorDoesNotHave) {
  const point_cloud_t message = to_message(camera_cloud());
  EXPECT_EQ(message.intensities_size, 0);
  EXPECT_EQ(message.rings_size, 0);
  const Cloud back = from_message(message);
  EXPECT_TRUE(back.intensities.empty());
  EXPECT_TRUE(back.rings.empty());
}

TEST(PointCloudCodec, CarriesEmptyAndOnePointClouds) {
  Cloud cloud;
  cloud.stamp = test_stamp();
  cloud.height = 1;
  EXPECT_TRUE(from_message(to_message(cloud)).points_m.empty());
  cloud.points_m = {{0.0F, 0.0F, 1.0F}};
  cloud.width = 1;
  EXPECT_EQ(from_message(to_message(cloud)).points_m.size(), 1U);
}

TEST(PointCloudCodec, RejectsSizesThatDoNotFit) {
  const point_cloud_t good = to_message(camera_cloud());
  point_cloud_t bad = good;
  bad.width = 41;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.width = -5;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.width = bad.height = 1'000'000;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.fx = std::nan("");
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.layout = 9;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.color.width = 20;
  EXPECT_THROW(from_message(bad), MessageError);
}

}  // namespace
}  // namespace limbcast::lcm_io
