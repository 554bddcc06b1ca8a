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

/// What a network tells of an arm that it marks for the right one too, from the elbow or from the
/// wrist on.
class OneArmMarkedTwice : public ::testing::Test {
 protected:
  Real visibility_of_wrist(ImageNetwork network, int first_joint_alike) {
    const BodyState body = testing::standing_body(2.5, 0.0);
    Segment segment = testing::colored(testing::seen(body));
    segment.image_poses.resize(kImageNetworkCount);
    ImagePose& pose = segment.image_poses.at(static_cast<std::size_t>(network));
    pose = testing::in_image(body, network);
    for (int joint = first_joint_alike; joint < kHip; joint += 2)
      pose.joints.at(joint + 1).px = pose.joints.at(joint).px + Eigen::Vector2f(2.0F, 2.0F);
    const auto observation = observe(segment, testing::stamp(), RefinedParams{});
    return observation.value().looks.at(0).joints.at(kWrist).visibility;
  }
};

TEST_F(OneArmMarkedTwice, TellsNothing) {
  for (const ImageNetwork network : {ImageNetwork::kBlazePose, ImageNetwork::kMoveNet})
    EXPECT_EQ(visibility_of_wrist(network, kElbow), 0.0);
}

TEST_F(OneArmMarkedTwice, IsNoneWhereHandsMeet) {
  EXPECT_EQ(visibility_of_wrist(ImageNetwork::kMoveNet, kWrist), 1.0);
}

TEST_F(OneArmMarkedTwice, CountsWhereDepthsTellOfHiddenArms) {
  EXPECT_EQ(visibility_of_wrist(ImageNetwork::kDepthPose, kElbow), 1.0);
}

}  // namespace
}  // namespace limbcast::pose_fitter::refined
