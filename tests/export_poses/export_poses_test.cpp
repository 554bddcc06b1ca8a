#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limbcast/body_poses_t.hpp>
#include <sstream>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/pose_json/pose_lines.hpp"
#include "tests/common/run_program.hpp"

namespace limbcast::export_poses {
namespace {

using limbcast::test::Outcome;
using limbcast::test::run_program;
using limbcast::test::TemporaryFolder;
using ::testing::HasSubstr;

BodyPoses poses_at(std::int64_t utime, int persons) {
  BodyPoses poses;
  poses.stamp.utime = utime;
  poses.stamp.sensor = "front";
  for (int i = 0; i < persons; ++i) {
    BodyPose person;
    person.id = i;
    person[Joint::kHead] = {true, {0.5F, -0.25F, 2.0F}, 0.9F, 0.02F, false};
    poses.persons.push_back(person);
  }
  return poses;
}

void write_log(const std::string& path) {
  lcm_io::LogWriter log(path);
  log.write(1, "BODY_POSES", lcm_io::to_message(poses_at(100, 1)));
  log.write(2, "TRACKED_POSES", lcm_io::to_message(poses_at(100, 2)));
  log.write(3, "OTHER", lcm_io::to_message(poses_at(7, 1)));
  log.write(4, "BODY_POSES", lcm_io::to_message(poses_at(200, 0)));
  log.close();
}

std::vector<BodyPoses> lines_of(const Outcome& outcome) {
  std::istringstream in(outcome.out);
  return pose_json::read_lines(in, "stdout");
}

Outcome export_poses(const std::vector<std::string>& arguments) {
  return run_program("limbcast-export-poses", arguments);
}

TEST(ExportPoses, WritesALineAFrameAlsoWhereNobodyIs) {
  const TemporaryFolder folder;
  write_log(folder / "a.log");
  const Outcome outcome = export_poses({folder / "a.log"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto frames = lines_of(outcome);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].stamp.utime, 100);
  ASSERT_EQ(frames[0].persons.size(), 1U);
  EXPECT_EQ(frames[0].persons[0][Joint::kHead].position_m, Eigen::Vector3f(0.5F, -0.25F, 2.0F));
  EXPECT_TRUE(frames[1].persons.empty());
}

TEST(ExportPoses, WritesAnotherChannelOnRequest) {
  const TemporaryFolder folder;
  write_log(folder / "a.log");
  const auto frames = lines_of(export_poses({folder / "a.log", "--channel", "TRACKED_POSES"}));
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].persons.size(), 2U);
}

TEST(ExportPoses, WritesReadableLinesOnRequest) {
  const TemporaryFolder folder;
  write_log(folder / "a.log");
  const Outcome outcome = export_poses({folder / "a.log", "--format", "text"});
  EXPECT_THAT(outcome.out, HasSubstr("person 0 at (0.50, -0.25, 2.00) m"));
  EXPECT_THAT(outcome.out, HasSubstr("nobody"));
}

TEST(ExportPoses, NamesTheChannelsOfALogThatHasPosesOnOthersOnly) {
  const TemporaryFolder folder;
  write_log(folder / "a.log");
  const Outcome outcome = export_poses({folder / "a.log", "--channel", "NONE"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "limbcast-export-poses: " + folder / "a.log" +
                             ": holds no poses on NONE but on BODY_POSES, OTHER, TRACKED_POSES; "
                             "choose such a channel, or limbcast-replay adds them (tracked ones "
                             "with --tracker)\n");
}

TEST(ExportPoses, LeavesOutMalformedAndTruncatedMessages) {
  const TemporaryFolder folder;
  {
    lcm_io::LogWriter log(folder / "a.log");
    log.write({1, "BODY_POSES", {1, 2, 3}});
    log.write(2, "BODY_POSES", lcm_io::to_message(poses_at(100, 1)));
    log.write(3, "BODY_POSES", lcm_io::to_message(poses_at(200, 1)));
    log.close();
  }
  std::filesystem::resize_file(folder / "a.log", std::filesystem::file_size(folder / "a.log") - 20);
  const Outcome outcome = export_poses({folder / "a.log"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(lines_of(outcome).size(), 1U);
  EXPECT_THAT(outcome.err, HasSubstr("1 malformed messages"));
  EXPECT_THAT(outcome.err, HasSubstr("is torn"));
}

TEST(ExportPoses, EndsWithTwoForLogsThatCannotBeUsed) {
  const TemporaryFolder folder;
  folder.write("empty.log", "");
  folder.write("foreign.log", "not an LCM log at all");
  for (const char* name : {"none.log", "empty.log", "foreign.log"}) {
    const Outcome outcome = export_poses({folder / name});
    EXPECT_EQ(outcome.exit_code, 2) << name;
    EXPECT_THAT(outcome.err, HasSubstr(name));
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(export_poses({folder / "none.log", "--no-such-option"}).exit_code, 2);
}

}  // namespace
}  // namespace limbcast::export_poses
