#include "common/lcm_io/body_poses_codec.hpp"

#include <gtest/gtest.h>

#include "common/lcm_io/message_error.hpp"
#include "tests/common/codec/codec_values.hpp"
#include "tests/common/infinite_numbers.hpp"

namespace limbcast::lcm_io {
namespace {

TEST(BodyPosesCodec, CarriesJointsPointingAndFigures) {
  BodyPoses poses;
  poses.stamp = test_stamp();
  BodyPose pose;
  pose.id = 3;
  pose[Joint::kHead] = {true, {0.1F, 0.2F, 2.0F}, 0.9F, 0.02F, false};
  pose.angles_rad.fill(kNaN);
  pose.error_terms = {1.0F, 2.0F, 3.0F, 4.0F};
  pose.pointing.push_back(
      {Side::kRight, {0.0F, 0.0F, -1.0F}, {0.0F, 0.0F, -1.0F}, {0.0F, 0.6F, -0.8F}, 0.02F, 0.97F});
  poses.persons = {pose};
  const BodyPoses back = from_message(to_message(poses));
  ASSERT_EQ(back.persons.size(), 1U);
  EXPECT_TRUE(back.persons[0][Joint::kHead].valid);
  EXPECT_EQ(back.persons[0][Joint::kHead].position_m, pose[Joint::kHead].position_m);
  EXPECT_FALSE(back.persons[0][Joint::kNeck].valid);
  EXPECT_EQ(back.persons[0].pointing[0].side, Side::kRight);
  EXPECT_EQ(back.persons[0].error_terms, pose.error_terms);
}

TEST(BodyPosesCodec, RejectsWrongNamesAndNumbers) {
  BodyPoses poses;
  poses.stamp = test_stamp();
  poses.persons.resize(1);
  poses.persons[0][Joint::kHead].valid = true;
  const body_poses_t good = to_message(poses);
  body_poses_t bad = good;
  bad.persons[0].joints[0].name = "tail";
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.persons[0].joints[0].position_m[2] = kInfinity;
  EXPECT_THROW(from_message(bad), MessageError);
}

}  // namespace
}  // namespace limbcast::lcm_io
