#include "modules/pose_fitter/refined/search/arm_search.hpp"

#include <gtest/gtest.h>

#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

constexpr int kLeftArm = 0;

/// The range image of a scan, in which a forearm 4 m away is three pixels wide.
PinholeCamera scan_camera() { return {320, 240, 150.0, 150.0, 159.5, 119.5}; }

/// How far away somebody stands, and where the left arm points.
struct PointingAtTheSensor {
  double distance_m;
  Vec3 direction;
};

class ArmBeforeTheTrunk : public ::testing::TestWithParam<PointingAtTheSensor> {};

TEST_P(ArmBeforeTheTrunk, IsFoundInTheFewPixelsOfARangeFinder) {
  const BodyState hanging = testing::standing_body(GetParam().distance_m, 0.0);
  BodyState pointing = hanging;
  testing::point_with(pointing, kLeftArm, GetParam().direction);
  const RefinedParams params;
  const Segment segment = testing::seen(pointing, 1 << 20, scan_camera());
  const auto observation = observe(segment, testing::stamp(), params);
  ASSERT_TRUE(observation.has_value());
  const auto postures =
      ArmSearch(*observation, params).postures(hanging, kLeftArm, kWithoutArms, 1);
  ASSERT_EQ(postures.size(), 1U);
  EXPECT_LT((postures[0].wrist - pointing.points[kWrist + kLeftArm]).norm(), 0.1);
  EXPECT_LT((postures[0].elbow - pointing.points[kElbow + kLeftArm]).norm(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(DistancesAndDirections, ArmBeforeTheTrunk,
                         ::testing::Values(PointingAtTheSensor{2.5, {-0.3, 0.2, -1.0}},
                                           PointingAtTheSensor{3.5, {-0.5, 0.2, -1.0}},
                                           PointingAtTheSensor{4.0, {-0.3, 0.4, -1.0}},
                                           PointingAtTheSensor{4.0, {-0.6, 0.4, -1.0}},
                                           PointingAtTheSensor{5.0, {0.3, 0.2, -1.0}}));

}  // namespace
}  // namespace limbcast::pose_fitter::refined
