#include "common/camera/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "common/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

using test::error_of;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

const FilePair kStereo{"left", "right"};

class RecordedFolder : public ::testing::Test {
 protected:
  void add_pair(const std::string& name) {
    folder_.write(name + "_left.jpg", "");
    folder_.write(name + "_right.jpg", "");
  }
  Recording find(const RecordingParams& params = {}) {
    return find_recording(folder_.path(), kStereo, params);
  }
  std::string error() {
    return error_of<InputError>([&] { find(); });
  }
  std::string error_of_timestamps(const std::string& text) {
    add_pair("a");
    folder_.write("timestamps.csv", text);
    return error();
  }
  TemporaryFolder folder_;
};

TEST_F(RecordedFolder, MakesTimesFromIndexAndRateWhereNobodyTellsThem) {
  for (const char* name : {"c", "a", "b"}) add_pair(name);

  const Recording recording = find({30.0, 1000});

  ASSERT_EQ(recording.frames.size(), 3U);
  EXPECT_FALSE(recording.has_timestamps);
  EXPECT_EQ(recording.frames[0].time.name, "a");
  EXPECT_EQ(recording.frames[0].time.utime, 1000);
  EXPECT_EQ(recording.frames[1].time.utime, 1000 + 33333);
  EXPECT_EQ(recording.frames[2].time.utime, 1000 + 66667);  // 2 / 30 s, rounded
  EXPECT_EQ(recording.frames[2].second_path, folder_ / "c_right.jpg");
}

TEST_F(RecordedFolder, TakesTimesAndGravityFromTimestamps) {
  add_pair("a");
  add_pair("b");
  folder_.write("timestamps.csv",
                "name,utime,down_x,down_y,down_z\r\nb,200,0,0.6,0.8\r\na,500,0,1,0\r\n");

  const Recording recording = find();

  ASSERT_EQ(recording.frames.size(), 2U);
  EXPECT_EQ(recording.frames[0].time.name, "b");
  EXPECT_EQ(recording.frames[0].time.utime, 200);
  ASSERT_TRUE(recording.frames[0].time.down);
  EXPECT_TRUE(recording.frames[0].time.down->isApprox(Eigen::Vector3f(0.0F, 0.6F, 0.8F)));
  EXPECT_EQ(recording.frames[1].time.name, "a");
}

TEST_F(RecordedFolder, CountsFramesThatTimestampsDoNotName) {
  for (const char* name : {"a", "b", "c"}) add_pair(name);
  folder_.write("timestamps.csv", "name,utime\nb,200\n");

  const Recording recording = find();

  EXPECT_EQ(recording.frames.size(), 1U);
  EXPECT_EQ(recording.frames_without_time, 2);
}

TEST_F(RecordedFolder, FindsTruthBesideAFrame) {
  add_pair("a");
  add_pair("b");
  folder_.write("b_gt.json", "{}");

  const Recording recording = find();

  EXPECT_EQ(recording.frames[0].truth_path, "");
  EXPECT_EQ(recording.frames[1].truth_path, folder_ / "b_gt.json");
}

TEST_F(RecordedFolder, LeavesOtherFilesAlone) {
  add_pair("a");
  for (const char* name : {"a_depth.png", "a_mask.png", "notes_left.txt", "calibration.yml"}) {
    folder_.write(name, "");
  }
  EXPECT_EQ(find().frames.size(), 1U);
}

TEST_F(RecordedFolder, LeavesFoldersAloneThatAreCalledLikeFrames) {
  add_pair("a");
  for (const char* name : {"b_left.jpg", "c.pcd", "a_gt.json"})
    std::filesystem::create_directory(folder_ / name);
  folder_.write("real", "");
  for (const char* name : {"d_left.png", "d_right.png", "d.pcd"})
    std::filesystem::create_symlink(folder_ / "real", folder_ / name);

  const Recording pairs = find();
  const Recording clouds = find_recording_of_files(folder_.path(), {".pcd"}, {});

  ASSERT_EQ(pairs.frames.size(), 2U);
  EXPECT_EQ(pairs.frames[0].truth_path, "");
  EXPECT_EQ(pairs.frames[1].time.name, "d");
  ASSERT_EQ(clouds.frames.size(), 1U);
  EXPECT_EQ(clouds.frames[0].first_path, folder_ / "d.pcd");
}

TEST_F(RecordedFolder, RefusesLinksToWhatIsNotThere) {
  add_pair("a");
  EXPECT_EQ(find().frames.size(), 1U);
  for (const char* name : {"b_left.jpg", "a_gt.json"}) {
    const std::string link = folder_ / name;
    std::filesystem::create_symlink("/nowhere/b.jpg", link);
    EXPECT_EQ(error(), link +
                           ": is a link to what is not there or may not be read; mount or copy "
                           "it, or remove the link");
    std::filesystem::remove(link);
  }
  std::filesystem::create_symlink(folder_ / "a_left.jpg", folder_ / "b_left.jpg");
  std::filesystem::create_symlink("a_right.jpg", folder_ / "b_right.jpg");
  EXPECT_EQ(find().frames.size(), 2U);
  std::filesystem::create_symlink("/nowhere/t.csv", folder_ / "timestamps.csv");
  EXPECT_THAT(error(), HasSubstr("timestamps.csv: cannot be read"));
}

TEST_F(RecordedFolder, RefusesNanosecondsForMicroseconds) {
  EXPECT_THAT(error_of_timestamps("name,utime\na,1767540000000000000\n"),
              HasSubstr("timestamps.csv:2: utime is '1767540000000000000'; must be microseconds "
                        "since 1970, not nanoseconds"));
}

TEST_F(RecordedFolder, RefusesAFolderForTimestamps) {
  add_pair("a");
  std::filesystem::create_directory(folder_ / "timestamps.csv");
  EXPECT_THAT(error(), HasSubstr("timestamps.csv: is a folder"));
}

TEST_F(RecordedFolder, RefusesAPipeForTimestamps) {
  add_pair("a");
  ASSERT_EQ(mkfifo((folder_ / "timestamps.csv").c_str(), S_IRUSR | S_IWUSR), 0);
  EXPECT_THAT(error(), HasSubstr("timestamps.csv: is a pipe; remove or rename it"));
}

TEST_F(RecordedFolder, NamesAMissingPartner) {
  add_pair("a");
  folder_.write("b_left.png", "");
  EXPECT_THAT(error(), AllOf(HasSubstr("b_left.png has no partner b_right.jpg")));
}

TEST_F(RecordedFolder, RefusesTheSamePictureTwice) {
  add_pair("a");
  folder_.write("a_left.png", "");
  EXPECT_THAT(error(), HasSubstr("remove one"));
}

TEST_F(RecordedFolder, ThatIsEmptyOrMissingIsAnError) {
  EXPECT_THAT(error(), HasSubstr("has no NAME_left and NAME_right pictures"));
  EXPECT_THAT(error_of<InputError>([&] { find_recording(folder_ / "none", kStereo, {}); }),
              HasSubstr("none: is no folder"));
}

TEST_F(RecordedFolder, TimestampsThatNameAMissingFrameAreAnError) {
  EXPECT_THAT(error_of_timestamps("name,utime\na,1\nb,2\n"),
              HasSubstr("names 'b', but there is no such frame"));
}

TEST_F(RecordedFolder, TornTimestampsAreAnErrorWithTheLine) {
  EXPECT_THAT(error_of_timestamps("name,utime,down_x,down_y,down_z\na,1,0,1,0\nb,2,0,"),
              AllOf(HasSubstr("timestamps.csv:3: has 4 fields, the header 5")));
}

TEST_F(RecordedFolder, TimestampsWithoutANumberAreAnError) {
  EXPECT_THAT(error_of_timestamps("name,utime\na,1.5e9\n"), HasSubstr(":2: utime is '1.5e9'"));
  EXPECT_THAT(error_of_timestamps("name,utime\na,-5\n"), HasSubstr(":2: utime is '-5'"));
  EXPECT_THAT(error_of_timestamps("name,utime,down_x,down_y,down_z\na,1,0,nan,0\n"),
              HasSubstr(":2: down_x, down_y, down_z are no unit vector"));
}

TEST_F(RecordedFolder, BlankLinesAndAByteOrderMarkInTimestampsSayNothing) {
  add_pair("a");
  folder_.write("timestamps.csv", "\xEF\xBB\xBF\r\nname,utime\r\n\r\na,7\r\n  \t\n\r\n\n");
  const Recording recording = find();
  ASSERT_EQ(recording.frames.size(), 1U);
  EXPECT_EQ(recording.frames[0].time.utime, 7);
}

TEST_F(RecordedFolder, TimestampsCountBlankLinesInErrors) {
  EXPECT_THAT(error_of_timestamps("\nname,utime\n\na,x\n"), HasSubstr(":4: utime is 'x'"));
}

TEST_F(RecordedFolder, TimestampsWithAForeignHeaderAreAnError) {
  EXPECT_THAT(error_of_timestamps("a,1\n"), HasSubstr(":1: the header is 'a,1'"));
  EXPECT_THAT(error_of_timestamps(""), HasSubstr(":1: the header is ''"));
}

TEST_F(RecordedFolder, NamesAndTimesThatStandTwiceAreAnError) {
  EXPECT_THAT(error_of_timestamps("name,utime\na,1\na,2\n"), HasSubstr(":3: 'a' stands twice"));
  EXPECT_THAT(error_of_timestamps("name,utime\na,1\nb,1\n"), HasSubstr(":3: utime 1 stands twice"));
}

TEST_F(RecordedFolder, TimestampsWithoutALineAreAnError) {
  EXPECT_THAT(error_of_timestamps("name,utime\n"), HasSubstr("names no frame"));
}

}  // namespace
}  // namespace limbcast
