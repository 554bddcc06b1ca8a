#include "common/shortest_turn.hpp"

#include <gtest/gtest.h>

namespace limbcast {
namespace {

using Eigen::Vector3d;

TEST(ShortestTurn, TakesOneDirectionToTheOtherByTheAngleBetweenThem) {
  const Vector3d from(0.3, -0.2, 0.9), to(-2.0, 1.0, 0.5);
  const Eigen::Quaterniond turn = shortest_turn(from, to);
  EXPECT_TRUE((turn * from.normalized()).isApprox(to.normalized(), 1e-12));
  const double angle_rad = std::acos(from.normalized().dot(to.normalized()));
  EXPECT_NEAR(Eigen::AngleAxisd(turn).angle(), angle_rad, 1e-12);
}

TEST(ShortestTurn, IsHalfATurnBetweenOppositeDirections) {
  for (const Vector3d& from : {Vector3d(1.0, 0.0, 0.0), Vector3d(-0.3, 0.2, 0.8)}) {
    const Eigen::Quaterniond turn = shortest_turn<double>(from, -from);
    EXPECT_TRUE((turn * from).isApprox(-from, 1e-12)) << from.transpose();
    EXPECT_NEAR(turn.norm(), 1.0, 1e-12);
  }
}

TEST(ShortestTurn, IsNoneBetweenEqualDirections) {
  const Vector3d direction(0.1, 0.2, -0.7);
  EXPECT_TRUE(shortest_turn<double>(direction, 3.0 * direction)
                  .isApprox(Eigen::Quaterniond::Identity(), 1e-12));
}

}  // namespace
}  // namespace limbcast
