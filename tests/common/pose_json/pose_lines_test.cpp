#include "common/pose_json/pose_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "common/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::pose_json {
namespace {

using testing::HasSubstr;

BodyPoses one_person() {
  BodyPoses poses;
  poses.stamp.utime = 1768870000000000;
  poses.stamp.sensor = "front";
  BodyPose person;
  person.id = 3;
  person.error = 0.25F;
  person.confidence = 0.5F;
  person[Joint::kHead] = {true, {0.1F, -0.2F, 2.5F}, 0.75F, 0.03F, false};
  Pointing arm;
  arm.side = Side::kRight;
  arm.direction = {0.0F, 0.0F, -1.0F};
  arm.forearm = {0.0F, 0.6F, -0.8F};
  arm.head_hand = {1.0F, 0.0F, 0.0F};
  arm.sigma_rad = 0.034906585F;  // 2 degrees
  arm.confidence = 0.9F;
  person.pointing.push_back(arm);
  poses.persons.push_back(person);
  return poses;
}

std::string error_of(const std::string& line) {
  try {
    from_line(line, "poses.jsonl: line 7");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PoseLines, HaveTheKeysThatUsersRelyOn) {
  const std::string line = to_line(one_person());
  EXPECT_THAT(line, testing::StartsWith(R"({"utime":1768870000000000,)"));
  EXPECT_THAT(line, HasSubstr(R"("head":[0.1,-0.2,2.5])"));
  EXPECT_THAT(line, HasSubstr(R"("wrist_left":null)"));
  EXPECT_THAT(line,
              HasSubstr(R"("side":"right","direction":[0.0,0.0,-1.0],"forearm":[0.0,0.6,-0.8])"));
  EXPECT_THAT(line, HasSubstr(R"("sigma_deg":2.0)"));
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST(PoseLines, SayNullWhereNobodyPointsAndEmptyWhereNobodyIs) {
  BodyPoses poses = one_person();
  poses.persons[0].pointing.clear();
  EXPECT_THAT(to_line(poses), HasSubstr(R"("pointing":null)"));
  poses.persons.clear();
  EXPECT_THAT(to_line(poses), HasSubstr(R"("persons":[])"));
}

TEST(PoseLines, SayNullForADirectionThatIsNotKnown) {
  BodyPoses poses = one_person();
  poses.persons[0].pointing[0].head_hand.setZero();  // the head was left out
  const std::string line = to_line(poses);
  EXPECT_THAT(line, HasSubstr(R"("head_hand":null)"));
  EXPECT_TRUE(from_line(line, "here").persons.at(0).pointing.at(0).head_hand.isZero());
}

TEST(PoseLines, AreReadBackAsTheyWereWritten) {
  const BodyPoses poses = from_line(to_line(one_person()), "here");
  ASSERT_EQ(poses.persons.size(), 1U);
  const BodyPose& person = poses.persons[0];
  EXPECT_EQ(poses.stamp.utime, 1768870000000000);
  EXPECT_EQ(poses.stamp.sensor, "front");
  EXPECT_EQ(person.id, 3);
  EXPECT_TRUE(person[Joint::kHead].valid);
  EXPECT_FALSE(person[Joint::kNeck].valid);
  EXPECT_NEAR(person[Joint::kHead].position_m.z(), 2.5F, 1e-6F);
  EXPECT_NEAR(person[Joint::kHead].sigma_m, 0.03F, 1e-6F);
  ASSERT_EQ(person.pointing.size(), 1U);
  EXPECT_EQ(person.pointing[0].side, Side::kRight);
  EXPECT_NEAR(person.pointing[0].sigma_rad, 0.0349066F, 1e-6F);
  const Pointing arm = one_person().persons[0].pointing[0];
  EXPECT_TRUE(person.pointing[0].direction.isApprox(arm.direction, 1e-4F));
  EXPECT_TRUE(person.pointing[0].forearm.isApprox(arm.forearm, 1e-4F));
  EXPECT_TRUE(person.pointing[0].head_hand.isApprox(arm.head_hand, 1e-4F));
  EXPECT_NEAR(person.pointing[0].confidence, arm.confidence, 1e-4F);
  EXPECT_NEAR(person.confidence, one_person().persons[0].confidence, 1e-4F);
  EXPECT_NEAR(person.error, one_person().persons[0].error, 1e-4F);
}

TEST(PoseLines, NeedOnlySideAndDirectionOfAnArm) {
  const BodyPoses poses = from_line(
      R"({"utime":5,"persons":[{"joints":{},"pointing":{"side":"left","direction":[0,0,-1],
          "forearm":null,"head_hand":null,"confidence":null}}]})",
      "here");
  const Pointing& arm = poses.persons.at(0).pointing.at(0);
  EXPECT_EQ(arm.side, Side::kLeft);
  EXPECT_TRUE(arm.forearm.isZero());
  EXPECT_TRUE(arm.head_hand.isZero());
  EXPECT_EQ(arm.confidence, 0.0F);
}

TEST(PoseLines, OfTheBareFormAreReadToo) {
  const BodyPoses poses = from_line(
      R"({"utime":5,"persons":[{"id":1,"error":0.1,"joints":{"head":[0,0,2]},"pointing":null}]})",
      "here");
  EXPECT_TRUE(poses.persons.at(0)[Joint::kHead].valid);
  EXPECT_TRUE(poses.persons.at(0).pointing.empty());
}

TEST(PoseLines, ThatAreWrongAreNamedByFileLineAndField) {
  EXPECT_THAT(error_of("{\"utime\":1"), HasSubstr("poses.jsonl: line 7: is no JSON"));
  EXPECT_THAT(error_of("[]"), HasSubstr("'utime'"));
  EXPECT_THAT(error_of(R"({"utime":1.5,"persons":[]})"),
              HasSubstr("'utime' must be a whole number"));
  EXPECT_THAT(error_of(R"({"utime":1})"), HasSubstr("'persons' is missing"));
  EXPECT_THAT(error_of(R"({"utime":1,"persons":{}})"), HasSubstr("'persons' must be a list"));
  EXPECT_THAT(error_of(R"({"utime":1,"persons":[{"joints":{"head":[0,0]}}]})"),
              HasSubstr("'head' must be three numbers"));
  EXPECT_THAT(error_of(R"({"utime":1,"persons":[{"joints":{"head":[0,0,1e99]}}]})"),
              HasSubstr("'head' is not finite"));
  EXPECT_THAT(error_of(R"({"utime":1,"persons":[{"joints":{},"pointing":{"side":"up"}}]})"),
              HasSubstr("'side' must be"));
  EXPECT_THAT(error_of(R"({"utime":1,"persons":[{"joints":{},"joint_sigma":3}]})"),
              HasSubstr("'joint_sigma' must be"));
  EXPECT_THAT(error_of(R"({"utime":1,"persons":[{"joints":{"head":[0,0,1,2]}}]})"),
              HasSubstr("'head' must be three numbers"));
  EXPECT_THAT(
      error_of(
          R"({"utime":1,"persons":[{"joints":{},"pointing":{"side":"left","direction":[0,0,0]}}]})"),
      HasSubstr("'direction' has no direction"));
  EXPECT_THAT(error_of(R"({"utime":1,"persons":[7]})"), HasSubstr("no JSON object"));
}

TEST(PoseLines, HaveNoNumberThatWouldBeWrapped) {
  const std::string id = R"({"utime":1,"persons":[{"joints":{},"id":)";
  EXPECT_EQ(error_of(id + "4294967297}]}"),
            "poses.jsonl: line 7: 'id' must be a whole number of 32 bits, is 4294967297");
  EXPECT_THAT(error_of(id + "-2147483649}]}"), HasSubstr("of 32 bits, is -2147483649"));
  EXPECT_THAT(error_of(id + "99999999999999999999}]}"), HasSubstr("'id' must be a whole number"));
  EXPECT_THAT(error_of(id + R"("D1"}]})"), HasSubstr("of 32 bits, is \"D1\""));
  EXPECT_THAT(error_of(R"({"utime":18446744073709551615,"persons":[]})"),
              HasSubstr("'utime' must be a whole number of 64 bits, is 18446744073709551615"));
  EXPECT_THAT(error_of(R"({"utime":1,"persons":[{"joints":{},"confidence":1e99}]})"),
              HasSubstr("'confidence' is not finite"));
  EXPECT_EQ(from_line(id + "-2147483648}]}", "here").persons.at(0).id, -2147483648);
  EXPECT_EQ(from_line(id + "null}]}", "here").persons.at(0).id, 0);
}

TEST(PoseLines, NameNoJointThatIsNone) {
  EXPECT_EQ(error_of(R"({"utime":1,"persons":[{"joints":{"elbow_lft":[0,0,1]}}]})"),
            "poses.jsonl: line 7: 'elbow_lft' is no joint, must be one of head, neck, chest, "
            "pelvis, shoulder_left, shoulder_right, elbow_left, elbow_right, wrist_left, "
            "wrist_right, hip_left, hip_right, knee_left, knee_right, ankle_left, ankle_right");
  EXPECT_THAT(error_of(R"({"utime":1,"persons":[{"joints":{},"joint_confidence":{"nose":1}}]})"),
              HasSubstr("'nose' is no joint"));
  EXPECT_THAT(error_of(R"({"utime":1,"persons":[{"joints":{},"joint_sigma":{"hand":1}}]})"),
              HasSubstr("'hand' is no joint"));
}

TEST(PoseLines, AreCountedWithEmptyLines) {
  std::istringstream in("{\"utime\":1,\"persons\":[]}\n\n{\"utime\":2}\n");
  EXPECT_THAT([&] { read_lines(in, "f"); },
              testing::ThrowsMessage<InputError>(HasSubstr("f: line 3: 'persons' is missing")));
}

TEST(PoseLines, ThatAreNoneAreToldWhereTheyComeFrom) {
  std::istringstream in("{\"utime\":1,\"persons\":[]}\n1768870000000000 nobody\n");
  EXPECT_THAT([&] { read_lines(in, "garbage.txt"); },
              testing::ThrowsMessage<InputError>(testing::StrEq(
                  "garbage.txt: line 2: is no JSON; give a file that limbcast-export-poses wrote "
                  "(with --format json, its default)")));
}

TEST(PoseLines, OfAMissingFileAreAnError) {
  EXPECT_THAT([] { read_file("/no/such/file.jsonl"); },
              testing::ThrowsMessage<InputError>(HasSubstr("/no/such/file.jsonl: cannot be read")));
}

TEST(PoseLines, OfAnEmptyFileAreAnError) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("poses.jsonl", "\n");
  EXPECT_EQ(test::error_of<InputError>([&] { read_file(path); }),
            path +
                ": holds no frame; give a file that limbcast-export-poses wrote (with --format "
                "json, its default)");
}

TEST(PoseLines, OfAFolderAreAnError) {
  EXPECT_THAT([] { read_file("/"); },
              testing::ThrowsMessage<InputError>(HasSubstr("/: is a folder; give a file")));
}

}  // namespace
}  // namespace limbcast::pose_json
