#include "modules/simulate/motion.hpp"

#include <gtest/gtest.h>

#include "modules/simulate/scenario.hpp"

namespace limbcast::simulate {
namespace {

const PinholeCamera kSmallCamera{160, 120, 130.0, 130.0, 79.5, 59.5};

ScenarioParams sequence(MotionKind motion) {
  ScenarioParams params;
  params.set = SetKind::kSequence;
  params.motion = motion;
  return params;
}

Person person_at(MotionKind motion, double seconds) {
  return draw_scenario(sequence(motion), kSmallCamera, 3, static_cast<int>(10.0 * seconds))
      .persons.at(0);
}

double moved_m(const Person& a, const Person& b, Joint joint) {
  return (a.skeleton[joint] - b.skeleton[joint]).norm();
}

TEST(Motion, KeepsTheBodyAndMovesByCentimetresAFrame) {
  for (const MotionKind kind : {MotionKind::kWalkPoint, MotionKind::kWave, MotionKind::kPointAround,
                                MotionKind::kSitDown}) {
    Person before = person_at(kind, 0.0);
    for (int i = 1; i < 60; ++i) {
      const Person now = person_at(kind, i / 10.0);
      EXPECT_EQ(now.body.stature_m, before.body.stature_m);
      for (int j = 0; j < kJointCount; ++j) {
        // A hand that is raised in 0.7 s goes up to 4 m/s.
        EXPECT_LT(moved_m(now, before, static_cast<Joint>(j)), 0.45)
            << kJointNames[j] << " at " << i;
      }
      before = now;
    }
  }
}

TEST(Motion, AWalkerStopsAndPoints) {
  const Person walking_person = person_at(MotionKind::kWalkPoint, 1.0);
  const Person end = person_at(MotionKind::kWalkPoint, 4.0);

  EXPECT_EQ(walking_person.posture.pointing_side, -1);
  EXPECT_GE(end.posture.pointing_side, 0);
  EXPECT_GT(moved_m(person_at(MotionKind::kWalkPoint, 0.0), end, Joint::kPelvis), 1.0);
  EXPECT_LT(moved_m(person_at(MotionKind::kWalkPoint, 5.0), end, Joint::kWristLeft), 1e-9);
}

TEST(Motion, SomebodySitsDownOnAFootThatStays) {
  const Person standing = person_at(MotionKind::kSitDown, 0.5);
  const Person sitting = person_at(MotionKind::kSitDown, 3.0);

  EXPECT_TRUE(sitting.posture.seated);
  EXPECT_GT(sitting.skeleton[Joint::kPelvis].y() - standing.skeleton[Joint::kPelvis].y(),
            0.2);  // y is down
  const auto between_feet = [](const Person& person) {
    return Eigen::Vector3d(
        0.5 * (person.skeleton[Joint::kAnkleLeft] + person.skeleton[Joint::kAnkleRight]));
  };
  EXPECT_LT((between_feet(standing) - between_feet(sitting)).norm(), 0.15);
}

TEST(Motion, APointerPointsAtThreeThingsWithOneArm) {
  const Person first = person_at(MotionKind::kPointAround, 0.5);
  const Person second = person_at(MotionKind::kPointAround, 2.5);
  const auto side = static_cast<Side>(first.posture.pointing_side);

  EXPECT_EQ(first.posture.pointing_side, second.posture.pointing_side);
  EXPECT_GT((arm_axis(first.skeleton, side) - arm_axis(second.skeleton, side)).norm(), 0.05);
}

TEST(Between, StartsAndEndsWhereItIsTold) {
  Posture from;
  Posture to;
  to.arms[0].upper = Eigen::Vector3d::UnitX();
  to.lean_rad = 0.4;

  EXPECT_LT((between(from, to, 0.0).arms[0].upper - from.arms[0].upper.normalized()).norm(), 1e-9);
  EXPECT_LT((between(from, to, 1.0).arms[0].upper - to.arms[0].upper).norm(), 1e-9);
  EXPECT_NEAR(between(from, to, 0.5).lean_rad, 0.2, 1e-12);
  EXPECT_NEAR(between(from, to, 0.5).arms[0].upper.norm(), 1.0, 1e-9);
}

}  // namespace
}  // namespace limbcast::simulate
