#include "modules/pose_fitter/refined/search/image_start.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "modules/pose_fitter/refined/search/pose_search.hpp"
#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

using testing::kDegree;

/// A body that looks a little to the side and points past the sensor.
BodyState pointing_body() {
  BodyState body = testing::standing_body(2.5, 30.0 * kDegree);
  testing::point_with(body, 0, {0.8, -0.2, -0.6});
  return body;
}

/// Bent forward at the hips, as who looks for something on the floor.
BodyState bent_body(Real angle_rad) {
  BodyState body = testing::standing_body(3.0, 0.0);
  const Vec3 hips = body.points[kPelvis];
  const Mat3 turn = Eigen::AngleAxis<Real>(angle_rad, body.rotation.col(0)).toRotationMatrix();
  for (int point = 0; point < kPointCount; ++point) {
    const bool of_legs = (point >= kHip && point < kHand) || point >= kToe;
    if (!of_legs) body.points[point] = hips + turn * (body.points[point] - hips);
  }
  body.rotation = turn * body.rotation;
  return body;
}

/// What a sensor sees of it, with a network that sees `shown`.
Segment seen_as(const BodyState& body, const BodyState& shown) {
  Segment segment = testing::seen(body);
  segment.image_poses = {testing::in_image(shown)};
  return segment;
}

Observation observed(const Segment& segment) {
  return observe(segment, testing::stamp(), RefinedParams{}).value();
}

/// As the first network sees it.
std::optional<BodyState> start_of(const Observation& observation, const BodyState& like) {
  return body_in_image(observation, observation.looks.front(), like);
}

Real error_m(const BodyState& found, const BodyState& truth, int point) {
  return (found.points[point] - truth.points[point]).norm();
}

TEST(ImageStart, PutsTheJointsWhereImageAndSurfaceShowThem) {
  const BodyState truth = pointing_body();

  const auto start = start_of(observed(seen_as(truth, truth)), testing::standing_body(2.5, 0));

  ASSERT_TRUE(start);
  for (int point = 0; point < kPointCount; ++point) EXPECT_LT(error_m(*start, truth, point), 0.15);
  EXPECT_GT(start->front().dot(truth.front()), std::cos(15.0 * kDegree));
}

TEST(ImageStart, TakesTheNetworksDepthWhereAnotherLimbCoversAJoint) {
  BodyState truth = testing::standing_body(2.5, 0.0);
  // A hand on the back.
  const Vec3 hand = truth.points[kChest] + Vec3(0.0, 0.0, 0.35);
  truth.points[kWrist] = truth.points[kHand] = hand;

  const auto start = start_of(observed(seen_as(truth, truth)), truth);

  ASSERT_TRUE(start);
  EXPECT_NEAR(start->points[kWrist].z(), hand.z(), 0.1);
}

TEST(ImageStart, IsNoneWhereTheImageShowsNoTrunk) {
  const BodyState body = pointing_body();
  Observation observation = observed(seen_as(body, body));
  observation.looks.front().joints[kHip].visibility = 0.0;
  EXPECT_FALSE(start_of(observation, body));
  observation.looks.clear();
  EXPECT_TRUE(looks_to_start_from(observation).empty());
}

TEST(ImageStart, IsNoneWhereTheImageShowsThePersonBesideTheCloud) {
  const BodyState body = pointing_body();
  BodyState beside = body;
  for (Vec3& point : beside.points) point.x() += 1.0;
  EXPECT_FALSE(start_of(observed(seen_as(body, beside)), body));
}

TEST(ImageStart, FindsABentBodyThatNoUprightStartReaches) {
  const BodyState truth = bent_body(90.0 * kDegree);
  Segment segment = seen_as(truth, truth);
  const auto error_of_neck_m = [&] {
    const Observation observation = observed(segment);
    const RefinedParams params;
    return error_m(PoseSearch(observation, params).run().front().body, truth, kNeck);
  };
  EXPECT_LT(error_of_neck_m(), 0.05);
  segment.image_poses.clear();
  EXPECT_GT(error_of_neck_m(), 0.1);
}

TEST(ImageStart, AsksTheSecondNetworkWhereItSeesAnotherBody) {
  const BodyState body = pointing_body();
  BodyState nearly = body, elsewhere = body;
  for (Vec3& point : nearly.points) point.x() += 0.05;
  for (Vec3& point : elsewhere.points) point.x() += 0.3;
  Segment segment = testing::colored(testing::seen(body));
  const auto count_looks = [&](const BodyState& seen_by_first) {
    segment.image_poses = {testing::in_image(seen_by_first), testing::in_image(body)};
    return looks_to_start_from(observed(segment)).size();
  };
  EXPECT_EQ(count_looks(nearly), 1U);
  EXPECT_EQ(count_looks(elsewhere), 2U);
}

TEST(ImageStart, IsWhatTheNetworkOfDepthsSeesWhereNoOtherLooked) {
  const BodyState body = pointing_body();
  Segment segment = testing::seen(body);
  segment.image_poses = testing::in_depths(body);
  const Observation observation = observed(segment);
  ASSERT_EQ(observation.looks.size(), 1U);
  EXPECT_EQ(observation.looks.front().network, ImageNetwork::kDepthPose);
  const auto start = start_of(observation, testing::standing_body(2.5, 0));
  ASSERT_TRUE(start);
  EXPECT_LT(error_m(*start, body, kWrist), 0.15);
}

}  // namespace
}  // namespace limbcast::pose_fitter::refined
