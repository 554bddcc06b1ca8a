#include "common/pose_json/pose_text.hpp"

#include <gtest/gtest.h>

namespace limbcast::pose_json {
namespace {

TEST(PoseText, HasALineForEachPerson) {
  BodyPoses poses;
  poses.stamp.utime = 1775000000200000;
  BodyPose person;
  person.id = 2;
  person.error = 0.0314F;
  person[Joint::kHead] = {true, {-0.4F, 0.1F, 2.7F}, 1.0F, 0.0F, false};
  poses.persons.push_back(person);
  Pointing arm;
  arm.direction = {0.0F, 0.6F, -0.8F};
  arm.sigma_rad = 0.0349066F;
  person.pointing.push_back(arm);
  poses.persons.push_back(person);
  EXPECT_EQ(
      to_text(poses),
      "1775000000.200 s  person 2 at (-0.40, 0.10, 2.70) m, 1 of 16 joints, error 0.031, does "
      "not point\n"
      "1775000000.200 s  person 2 at (-0.40, 0.10, 2.70) m, 1 of 16 joints, error 0.031, left "
      "arm points to (0.00, 0.60, -0.80), sigma 2.0 degrees\n");
}

TEST(PoseText, SaysWhereNobodyIs) {
  BodyPoses poses;
  poses.stamp.utime = 1500000;
  EXPECT_EQ(to_text(poses), "1.500 s  nobody\n");
}

}  // namespace
}  // namespace limbcast::pose_json
