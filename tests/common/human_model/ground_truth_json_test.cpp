#include "common/human_model/ground_truth_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

using test::error_of;
using test::TemporaryFolder;
using ::testing::HasSubstr;

class GroundTruth : public ::testing::Test {
 protected:
  BodyPoses read(const std::string& text) {
    return read_ground_truth(folder_.write("a_gt.json", text));
  }
  BodyPose person(const std::string& more) {
    const BodyPoses truth = read(
        R"({"utime": 5, "persons": [{"joints": {"head": [0.1, -0.2, 3]}, "visible": {"head": true},)" +
        more + "}]}");
    EXPECT_EQ(truth.persons.size(), 1U);
    return truth.persons.at(0);
  }
  std::string error(const std::string& text) {
    return error_of<InputError>([&] { read(text); });
  }
  TemporaryFolder folder_;
};

TEST_F(GroundTruth, HasTimeAndGravity) {
  const BodyPoses truth = read(
      R"({"utime": 1768870000000000, "down": [0, 0.6, 0.8], "camera_height": 1.2, "persons": []})");
  EXPECT_EQ(truth.stamp.utime, 1768870000000000);
  EXPECT_EQ(truth.stamp.gravity.source, GravitySource::kRecording);
  EXPECT_TRUE(truth.stamp.gravity.down.isApprox(Eigen::Vector3f(0.0F, 0.6F, 0.8F)));
  EXPECT_FLOAT_EQ(truth.stamp.gravity.sensor_height_m.value(), 1.2F);
  EXPECT_TRUE(truth.persons.empty());
}

TEST_F(GroundTruth, KeepsHiddenJointsWithConfidenceZero) {
  const BodyPoses truth = read(R"({"utime": 5, "persons": [{"id": "D1",
      "joints": {"head": [0.1, -0.2, 3], "wrist_left": [1, 2, 3], "head_top": [0, 0, 0]},
      "visible": {"head": true, "wrist_left": false, "ankle_left": true}}]})");
  const BodyPose& pose = truth.persons.at(0);
  EXPECT_EQ(pose.id, 1);
  EXPECT_TRUE(pose[Joint::kHead].valid);
  EXPECT_EQ(pose[Joint::kHead].confidence, 1.0F);
  EXPECT_TRUE(pose[Joint::kHead].position_m.isApprox(Eigen::Vector3f(0.1F, -0.2F, 3.0F)));
  EXPECT_TRUE(pose[Joint::kWristLeft].valid);
  EXPECT_EQ(pose[Joint::kWristLeft].confidence, 0.0F);
  EXPECT_FALSE(pose[Joint::kAnkleLeft].valid);
}

TEST_F(GroundTruth, HasPointingOnlyWherePersonPoints) {
  EXPECT_TRUE(person(R"("pointing": null)").pointing.empty());
  const BodyPose pose = person(R"("id": 7, "pointing": {"side": "right", "direction": [0, 0, -1],
      "direction_elbow_wrist": [0, 1, 0], "direction_head_hand": [1, 0, 0], "arm_visible": true})");
  EXPECT_EQ(pose.id, 7);
  ASSERT_EQ(pose.pointing.size(), 1U);
  EXPECT_EQ(pose.pointing[0].side, Side::kRight);
  EXPECT_EQ(pose.pointing[0].direction, Eigen::Vector3f(0.0F, 0.0F, -1.0F));
  EXPECT_EQ(pose.pointing[0].forearm, Eigen::Vector3f::UnitY());
  EXPECT_EQ(pose.pointing[0].head_hand, Eigen::Vector3f::UnitX());
  EXPECT_EQ(pose.pointing[0].confidence, 1.0F);
}

TEST_F(GroundTruth, GivesAHiddenArmNoConfidence) {
  const BodyPose pose =
      person(R"("pointing": {"side": "left", "direction": [0, 0, -1], "arm_visible": false})");
  EXPECT_EQ(pose.pointing.at(0).confidence, 0.0F);
}

TEST_F(GroundTruth, TakesTheStraightArmWhereDepthSpoilsTheDirection) {
  const BodyPose pose = person(R"("pointing": {"side": "left", "direction": [0, 0, -1],
      "depth_consistent": false, "direction_straight_arm": [0, 1, 0]})");
  EXPECT_EQ(pose.pointing.at(0).direction, Eigen::Vector3f::UnitY());
  EXPECT_EQ(pose.pointing.at(0).confidence, 0.0F);
}

TEST_F(GroundTruth, NamesWhatIsWrong) {
  EXPECT_THAT(error("{\"utime\": 5, \"persons\": ["), HasSubstr("a_gt.json: is no valid JSON"));
  EXPECT_THAT(error("[]"), HasSubstr("'utime' is missing"));
  EXPECT_THAT(error(R"({"utime": "x", "persons": []})"),
              HasSubstr("'utime': is not a whole number"));
  EXPECT_THAT(error(R"({"utime": 5, "persons": [{"joints": {"head": [1, 2]}}]})"),
              HasSubstr("person 1: 'joints': 'head': is no list of 3 numbers"));
  EXPECT_THAT(error(R"({"utime": 5, "persons": [{"joints": {"head": [1, 2, "x"]}}]})"),
              HasSubstr("is not a number"));
  EXPECT_THAT(error(R"({"utime": 5, "persons": [{"joints": {}, "pointing": {"side": "up"}}]})"),
              HasSubstr("'side': is neither"));
  EXPECT_THAT(error(R"({"utime": 5, "persons": [{"joints": {},
                        "pointing": {"side": "left", "direction": [1, 1, 1]}}]})"),
              HasSubstr("is no unit vector"));
}

TEST_F(GroundTruth, HasNoNumberThatWouldBeWrapped) {
  EXPECT_THAT(error(R"({"utime": 5, "persons": [{"id": 4294967297, "joints": {}}]})"),
              HasSubstr("a_gt.json: person 1: 'id': is not a whole number of 32 bits but "
                        "4294967297; correct the truth file or remove it"));
  EXPECT_THAT(error(R"({"utime": 5, "persons": [{"id": 1.5, "joints": {}}]})"),
              HasSubstr("of 32 bits but 1.5"));
  EXPECT_THAT(error(R"({"utime": 18446744073709551615, "persons": []})"),
              HasSubstr("'utime': is not a whole number of 64 bits but 18446744073709551615"));
}

TEST_F(GroundTruth, IsNoFolder) {
  const std::string folder = folder_.path();
  EXPECT_EQ(error_of<InputError>([&] { read_ground_truth(folder); }),
            folder + ": is a folder; remove or rename it");
}

TEST_F(GroundTruth, OfEveryRecordingIsRead) {
  const std::string data = LIMBCAST_DATA_DIR;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";
  int frames = 0;
  int trusted_pointing = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    const std::string path = entry.path().string();
    if (path.find("_gt.json") == std::string::npos) continue;
    ++frames;
    for (const BodyPose& pose : read_ground_truth(path).persons) {
      for (const Pointing& pointing : pose.pointing) trusted_pointing += pointing.confidence > 0.0F;
    }
  }
  EXPECT_EQ(frames, 218 + 20 + 21);  // rendered pairs, laser scans, labelled RGB-D frames
  EXPECT_GT(trusted_pointing, 0);
}

}  // namespace
}  // namespace limbcast
