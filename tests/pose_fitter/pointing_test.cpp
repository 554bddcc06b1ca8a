#include "modules/pose_fitter/pointing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limbcast::pose_fitter {
namespace {

using Eigen::Vector3f;

constexpr float kRadPerDeg = 3.14159265F / 180.0F;
const Vector3f kDown(0.0F, 1.0F, 0.0F);

void place(BodyPose& body, Joint joint, const Vector3f& position_m) {
  body[joint].valid = true;
  body[joint].position_m = position_m;
}

/// A trunk along gravity at 3 m.
BodyPose trunk() {
  BodyPose body;
  place(body, Joint::kHead, {0.0F, -0.7F, 3.0F});
  place(body, Joint::kNeck, {0.0F, -0.5F, 3.0F});
  place(body, Joint::kPelvis, {0.0F, 0.1F, 3.0F});
  return body;
}

/// An arm in the plane of the picture: `raise_deg` of the upper arm from the trunk, bent by
/// `bend_deg`.
void add_arm(BodyPose& body, Side side, float raise_deg, float bend_deg) {
  const float sign = side == Side::kLeft ? 1.0F : -1.0F;
  const auto along = [&](float deg) {
    return Vector3f(sign * std::sin(deg * kRadPerDeg), std::cos(deg * kRadPerDeg), 0.0F);
  };
  const Vector3f shoulder(sign * 0.2F, -0.4F, 3.0F);
  const Vector3f elbow = shoulder + 0.25F * along(raise_deg);
  place(body, on_side(Joint::kShoulderLeft, side), shoulder);
  place(body, on_side(Joint::kElbowLeft, side), elbow);
  place(body, on_side(Joint::kWristLeft, side), elbow + 0.25F * along(raise_deg + bend_deg));
}

TEST(Pointing, GivesTheDirectionsOfAStraightRaisedArm) {
  BodyPose body = trunk();
  add_arm(body, Side::kLeft, 90.0F, 0.0F);
  const auto pointing = find_pointing(body, kDown);
  ASSERT_EQ(pointing.size(), 1U);
  EXPECT_EQ(pointing[0].side, Side::kLeft);
  EXPECT_NEAR(pointing[0].direction.x(), 1.0F, 1e-5F);
  EXPECT_NEAR(pointing[0].forearm.x(), 1.0F, 1e-5F);
  // From the head (0, -0.7) to the wrist (0.7, -0.4).
  EXPECT_NEAR(pointing[0].head_hand.x(), 0.7F / std::hypot(0.7F, 0.3F), 1e-5F);
}

TEST(Pointing, NeedsAnArmThatIsRaisedByMoreThan35Degrees) {
  for (const auto& [raise_deg, points] : {std::pair{34.0F, false}, {36.0F, true}}) {
    BodyPose body = trunk();
    add_arm(body, Side::kRight, raise_deg, 0.0F);
    EXPECT_EQ(!find_pointing(body, kDown).empty(), points) << raise_deg;
  }
}

TEST(Pointing, NeedsAnArmThatIsBentByLessThan45Degrees) {
  for (const auto& [bend_deg, points] : {std::pair{44.0F, true}, {46.0F, false}}) {
    BodyPose body = trunk();
    add_arm(body, Side::kRight, 60.0F, bend_deg);
    EXPECT_EQ(!find_pointing(body, kDown).empty(), points) << bend_deg;
  }
}

TEST(Pointing, PutsTheStraighterAndMoreRaisedArmFirst) {
  BodyPose body = trunk();
  add_arm(body, Side::kLeft, 60.0F, 20.0F);
  add_arm(body, Side::kRight, 90.0F, 0.0F);
  const auto pointing = find_pointing(body, kDown);
  ASSERT_EQ(pointing.size(), 2U);
  EXPECT_EQ(pointing[0].side, Side::kRight);
  EXPECT_EQ(pointing[1].side, Side::kLeft);
}

TEST(Pointing, SaysNothingOfAnArmOfWhichAJointWasLeftOut) {
  for (const Joint joint : {Joint::kShoulderLeft, Joint::kElbowLeft, Joint::kWristLeft}) {
    BodyPose body = trunk();
    add_arm(body, Side::kLeft, 90.0F, 0.0F);
    body[joint].valid = false;
    EXPECT_TRUE(find_pointing(body, kDown).empty());
  }
}

TEST(Pointing, TakesGravityWhereTheTrunkIsNotKnown) {
  BodyPose body = trunk();
  body[Joint::kPelvis].valid = false;
  add_arm(body, Side::kLeft, 34.0F, 0.0F);
  EXPECT_TRUE(find_pointing(body, kDown).empty());
  EXPECT_EQ(find_pointing(body, -kDown).size(), 1U);
}

TEST(Pointing, FollowsTheParametersOfTheRule) {
  BodyPose body = trunk();
  add_arm(body, Side::kLeft, 60.0F, 50.0F);
  EXPECT_TRUE(find_pointing(body, kDown).empty());
  EXPECT_EQ(find_pointing(body, kDown, {55.0, 35.0}).size(), 1U);
}

}  // namespace
}  // namespace limbcast::pose_fitter
