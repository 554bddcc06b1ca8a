#include "modules/pose_fitter/refined/observation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/pose_fitter/refined/refined_body.hpp"

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

/// How the left wrist counts that DepthPose, and MoveNet so far to the side, see.
class WristSeenInDepths : public ::testing::Test {
 protected:
  WristSeenInDepths() {
    segment_.image_poses = testing::in_depths(body_);
    segment_.image_poses.at(1) = testing::in_image(body_, ImageNetwork::kMoveNet);
  }
  ImageJoint& mark(ImageNetwork network) {
    return segment_.image_poses.at(static_cast<std::size_t>(network)).joints.at(kWrist);
  }
  SeenJoint counted(ImageNetwork network) const {
    const auto observation = observe(segment_, testing::stamp(), params_);
    for (const ImageLook& look : observation.value().looks)
      if (look.network == network) return look.joints.at(kWrist);
    throw std::logic_error("the network did not look");
  }
  void take_for_hidden() { mark(ImageNetwork::kDepthPose).visibility = kHidden; }

  static constexpr float kHidden = 0.01F;
  static constexpr Real kHalf = 0.5;
  const BodyState body_ = testing::standing_body(2.5, 0.0);
  Segment segment_ = testing::colored(testing::seen(body_));
  RefinedParams params_;
  const Real hidden_ = std::pow(kHidden, params_.image_visibility_exponent.back());
};

TEST_F(WristSeenInDepths, CountsWhereItIsHiddenTooAsNoOtherDoes) {
  take_for_hidden();
  mark(ImageNetwork::kMoveNet).visibility = kHidden;
  EXPECT_GT(hidden_, kHalf);
  EXPECT_NEAR(counted(ImageNetwork::kDepthPose).visibility, hidden_, 1e-6);
  EXPECT_NEAR(counted(ImageNetwork::kMoveNet).visibility, kHidden, 1e-6);
}

TEST_F(WristSeenInDepths, CountsLessWhereItIsHiddenAndColorsShowItElsewhere) {
  const Real side_px = 1.5 * params_.image_elsewhere_m / 2.5 * testing::camera().fx;
  mark(ImageNetwork::kMoveNet).px.x() += static_cast<float>(side_px);
  EXPECT_NEAR(counted(ImageNetwork::kDepthPose).visibility, 1.0, 1e-6);
  take_for_hidden();
  EXPECT_LT(counted(ImageNetwork::kDepthPose).visibility, kHalf * hidden_);
  mark(ImageNetwork::kMoveNet).px.x() -= static_cast<float>(side_px);
  EXPECT_NEAR(counted(ImageNetwork::kDepthPose).visibility, hidden_, 1e-6);
}

TEST_F(WristSeenInDepths, IsAsUnsureAsTheNetworkTells) {
  const auto spread_of = [&](double told_m) {
    mark(ImageNetwork::kDepthPose).spread_m = static_cast<float>(told_m);
    return counted(ImageNetwork::kDepthPose).spread;
  };
  const Real usual_m = params_.usual_mark_spread_m;
  EXPECT_NEAR(spread_of(usual_m), 1.0, 1e-6);
  EXPECT_NEAR(spread_of(4.0 * usual_m), std::pow(4.0, params_.mark_spread_exponent), 1e-6);
  EXPECT_NEAR(spread_of(1e-6), spread_of(params_.least_mark_spread_m), 1e-6);
  EXPECT_EQ(spread_of(0.0), 1.0) << "not told";
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
