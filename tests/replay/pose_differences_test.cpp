#include "tests/replay/pose_differences.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limbcast::replay {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

BodyPoses one_person(std::int64_t utime = 7) {
  BodyPose person;
  person[Joint::kHead] = {true, {0.0F, 0.0F, 2.0F}, 1.0F, 0.0F, false};
  Pointing arm;
  arm.direction = Eigen::Vector3f::UnitX();
  person.pointing.push_back(arm);
  BodyPoses poses;
  poses.stamp.utime = utime;
  poses.persons.push_back(person);
  return poses;
}

TEST(PoseDifferences, AreNoneWithinTheTolerance) {
  BodyPoses after = one_person();
  after.persons[0][Joint::kHead].position_m.x() += 0.004F;
  EXPECT_THAT(pose_differences({one_person()}, {after}), IsEmpty());
}

TEST(PoseDifferences, NameWhatMoved) {
  BodyPoses after = one_person();
  after.persons[0][Joint::kHead].position_m.x() += 0.02F;
  after.persons[0].pointing[0].direction = Eigen::Vector3f::UnitY();
  EXPECT_THAT(pose_differences({one_person()}, {after}),
              ElementsAre("utime 7 person 0: head moved by 2.0 cm",
                          "utime 7 person 0: direction turned by 90.0 degrees"));
}

TEST(PoseDifferences, NameWhatCameAndWent) {
  BodyPoses after = one_person();
  after.persons[0][Joint::kHead].valid = false;
  after.persons[0][Joint::kNeck].valid = true;
  after.persons[0].pointing.clear();
  after.persons.emplace_back();
  EXPECT_THAT(
      pose_differences({one_person()}, {after}),
      ElementsAre("utime 7: 2 persons, before 1", "utime 7 person 0: head left out, before found",
                  "utime 7 person 0: neck found, before left out",
                  "utime 7 person 0: does not point, before it did"));
}

TEST(PoseDifferences, NameFramesOfOneSide) {
  EXPECT_THAT(pose_differences({one_person(1), one_person(2)}, {one_person(2), one_person(3)}),
              ElementsAre("utime 1: frame is gone", "utime 3: frame is new"));
}

}  // namespace
}  // namespace limbcast::replay
