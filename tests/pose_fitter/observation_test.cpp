#include "modules/pose_fitter/refined/observation.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <utility>
#include <vector>

#include "tests/pose_fitter/refined_body.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Weight of all points of somebody before a sensor with this noise.
float weight_of_points(const DepthNoise& noise) {
  Stamp stamp = testing::stamp();
  stamp.depth_noise = noise;
  const auto observation =
      observe(testing::seen(testing::standing_body(2.5, 0.0)), stamp, RefinedParams{});
  const std::vector<float>& weights = observation.value().fine.weight;
  return std::accumulate(weights.begin(), weights.end(), 0.0F);
}

TEST(ObservedPoints, OfARangeFinderWeighMoreSinceTheirErrorsAreTheirOwn) {
  const RefinedParams params;
  ASSERT_GT(params.scan_point_weight, params.point_weight);
  const float of_camera = weight_of_points({0.005F, 0.002F}),
              of_scanner = weight_of_points({0.005F, 0.0F});
  const auto ratio = static_cast<float>(params.scan_point_weight / params.point_weight);
  // Smoothed depths move a point's share of the area by less than a hundredth.
  EXPECT_NEAR(of_scanner / of_camera, ratio, 0.01F * ratio);
}

/// How much the left wrist counts that DepthPose sees so surely.
Real counted_visibility_of_wrist(float visibility, bool has_colors) {
  const BodyState body = testing::standing_body(2.5, 0.0);
  Segment segment = testing::seen(body);
  if (has_colors) segment = testing::colored(std::move(segment));
  segment.image_poses = testing::in_depths(body);
  segment.image_poses.back().joints.at(kWrist).visibility = visibility;
  const auto observation = observe(segment, testing::stamp(), RefinedParams{});
  return observation.value().looks.at(0).joints.at(kWrist).visibility;
}

TEST(JointsSeenInDepths, CountWhereTheyAreHiddenToo) {
  const Real least = RefinedParams{}.image_least_visibility.back();
  ASSERT_GT(least, 0.0);
  for (const bool has_colors : {false, true})
    EXPECT_EQ(counted_visibility_of_wrist(0.0F, has_colors), least);
}

TEST(JointsSeenInDepths, CountMoreWhereNoColorsTellThemToo) {
  EXPECT_NEAR(counted_visibility_of_wrist(0.64F, true), 0.64, 1e-6);
  EXPECT_NEAR(counted_visibility_of_wrist(0.64F, false), 0.8, 1e-6);
}

}  // namespace
}  // namespace limbcast::pose_fitter::refined
