#include "modules/pose_fitter/refined/search/straight_arm.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "common/angle.hpp"
#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

constexpr int kLeft = 0;
const Vec3 kSideways(1.0, 0.0, 0.0);

/// A body whose left upper arm points sideways, and the forearm so far down from there.
BodyState body_with_elbow_bent(double bend_deg) {
  BodyState body = testing::standing_body(2.5, 0.0);
  testing::point_with(body, kLeft, kSideways);
  const Real forearm_m = (body.points[kWrist] - body.points[kElbow]).norm();
  const Real bend_rad = bend_deg * testing::kDegree;
  body.points[kWrist] =
      body.points[kElbow] + forearm_m * Vec3(std::cos(bend_rad), std::sin(bend_rad), 0.0);
  return body;
}

TEST(StraightArm, LiesAlongTheLineToTheWristTheUpperArmOrTheForearm) {
  const BodyState bent = body_with_elbow_bent(60.0);
  const std::vector<BodyState> tried = with_straight_arm(bent, kLeft);
  ASSERT_EQ(tried.size(), 3U);
  const std::array<Vec3, 3> directions = {bent.points[kWrist] - bent.points[kShoulder],
                                          bent.points[kElbow] - bent.points[kShoulder],
                                          bent.points[kWrist] - bent.points[kElbow]};
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const auto& points = tried[i].points;
    const Vec3 upper = points[kElbow] - points[kShoulder], fore = points[kWrist] - points[kElbow];
    EXPECT_LT(angle_deg(upper, directions[i]), 1e-6);
    EXPECT_LT(angle_deg(fore, directions[i]), 1e-6);
    EXPECT_NEAR(upper.norm(), (bent.points[kElbow] - bent.points[kShoulder]).norm(), 1e-9);
    EXPECT_NEAR(fore.norm(), (bent.points[kWrist] - bent.points[kElbow]).norm(), 1e-9);
    EXPECT_EQ(points[kWrist + 1], bent.points[kWrist + 1]) << "the other arm stays";
  }
}

TEST(StraightArm, IsTriedOfBentArmsOnly) {
  EXPECT_FALSE(with_straight_arm(body_with_elbow_bent(40.0), kLeft).empty());
  EXPECT_TRUE(with_straight_arm(body_with_elbow_bent(30.0), kLeft).empty());
}

TEST(StraightArm, IsToldFromABentAndAHangingOne) {
  EXPECT_TRUE(is_straight_and_raised(body_with_elbow_bent(0.0), kLeft));
  EXPECT_TRUE(is_straight_and_raised(body_with_elbow_bent(25.0), kLeft));
  EXPECT_FALSE(is_straight_and_raised(body_with_elbow_bent(35.0), kLeft));
  EXPECT_FALSE(is_straight_and_raised(testing::standing_body(2.5, 0.0), kLeft));
}

}  // namespace
}  // namespace limbcast::pose_fitter::refined
