#include "modules/log/extract.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limbcast/stereo_images_t.hpp>

#include "common/config/options.hpp"
#include "common/config/output_file.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/pose_json/pose_lines.hpp"
#include "tests/log/logs.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::logs {
namespace {

using lcm_io::LogEvent;
using ::testing::HasSubstr;

std::vector<LogEvent> on(const std::string& channel, const std::vector<LogEvent>& events) {
  std::vector<LogEvent> found;
  std::copy_if(events.begin(), events.end(), std::back_inserter(found),
               [&](const LogEvent& event) { return event.channel == channel; });
  return found;
}

class Extract : public ::testing::Test {
 protected:
  ExtractOptions options(const std::string& in, Extracted what) const {
    ExtractOptions options;
    options.in = in;
    options.folder = out_;
    options.what = what;
    return options;
  }
  const std::string folder_ = test::temporary_folder("log_extract");
  const std::string log_ = folder_ + "/in.log", out_ = folder_ + "/out";
};

TEST_F(Extract, OfImagesGivesTheSameLogWhenItIsReadBack) {
  const std::string in = test::repository_file("logs/multi.log"), back = folder_ + "/back.log";
  extract(options(in, Extracted::kImages));
  const auto run = test::run({test::program("limbcast-stereo-camera"), "--source", out_,
                              "--calibration", out_ + "/calibration.yml", "--log", back});
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto before = on("STEREO_IMAGES", events_in(in)),
             after = on("STEREO_IMAGES", events_in(back));
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto a = lcm_io::decode<stereo_images_t>(before[i].data),
               b = lcm_io::decode<stereo_images_t>(after[i].data);
    EXPECT_EQ(a.left.data, b.left.data);
    EXPECT_EQ(a.right.data, b.right.data);
    EXPECT_EQ(a.stamp.utime, b.stamp.utime);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a.stamp.down[axis], b.stamp.down[axis], 1e-5);
  }
  EXPECT_EQ(on("GROUND_TRUTH", events_in(back)).size(), before.size());
}

TEST_F(Extract, OfCloudsWritesFilesThatTheLaserScannerReads) {
  Cloud cloud;
  cloud.stamp.utime = kBegin;
  cloud.stamp.sensor = "front";
  cloud.width = 3;
  cloud.height = 1;
  cloud.points_m = {{1.0F, 2.0F, 3.0F}, {-1.0F, 0.5F, 4.0F}, {0.0F, 0.0F, 2.0F}};
  cloud.colors = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  cloud.intensities = {12.0F, 0.0F, 255.0F};
  cloud.rings = {0, 31, 300};
  {
    lcm_io::LogWriter log(log_);
    log.write(kBegin, "POINT_CLOUD", lcm_io::to_message(cloud));
    log.close();
  }
  EXPECT_EQ(extract(options(log_, Extracted::kClouds)).frames, 1);
  const std::string back = folder_ + "/back.log";
  const auto run =
      test::run({test::program("limbcast-laser-scanner"), "--source", out_, "--log", back});
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto events = on("POINT_CLOUD", events_in(back));
  ASSERT_EQ(events.size(), 1U);
  const Cloud read = lcm_io::from_message(lcm_io::decode<point_cloud_t>(events[0].data));
  ASSERT_EQ(read.points_m.size(), 3U);
  EXPECT_EQ(read.stamp.utime, kBegin);
  EXPECT_EQ(read.colors[1].b, 4);
  EXPECT_EQ(read.colors[1].r, 6);
  EXPECT_EQ(read.intensities, cloud.intensities);
  EXPECT_EQ(read.rings, cloud.rings);
}

TEST_F(Extract, OfPosesWritesALineAFrame) {
  write_ten_frames(log_);
  EXPECT_EQ(extract(options(log_, Extracted::kPoses)).frames, 10);
  const auto frames = pose_json::read_file(out_ + "/BODY_POSES.jsonl");
  ASSERT_EQ(frames.size(), 10U);
  EXPECT_EQ(frames[3].stamp.utime, kBegin + 3 * kFrame_us);
}

TEST_F(Extract, AsksForTheSensorWhereThereAreSeveral) {
  {
    lcm_io::LogWriter log(log_);
    for (const char* sensor : {"front", "rear"}) {
      Cloud cloud;
      cloud.stamp.utime = kBegin;
      cloud.stamp.sensor = sensor;
      cloud.width = cloud.height = 1;
      cloud.points_m = {{1.0F, 2.0F, 3.0F}};
      log.write(kBegin, "POINT_CLOUD", lcm_io::to_message(cloud));
    }
    log.close();
  }
  ExtractOptions clouds = options(log_, Extracted::kClouds);
  EXPECT_THROW(extract(clouds), config::UsageError);
  clouds.sensor = "rear";
  EXPECT_EQ(extract(clouds).frames, 1);
  clouds.sensor = "left";
  EXPECT_THROW(extract(clouds), config::UsageError);
}

TEST_F(Extract, NamesTheSensorsWhosePosesThereAre) {
  write_ten_frames(log_);
  ExtractOptions poses = options(log_, Extracted::kPoses);
  poses.sensor = "none";
  try {
    extract(poses);
    FAIL() << "must throw";
  } catch (const config::UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("holds nothing of sensor 'none', but of front"));
  }
}

/// A log with a frame of poses on each channel.
void write_poses_on(const std::string& path, const std::vector<std::string>& channels) {
  lcm_io::LogWriter log(path);
  for (const std::string& channel : channels) log.write(kBegin, channel, poses_of_frame(0));
  log.close();
}

TEST_F(Extract, OfPosesNamesItsFilesSafely) {
  write_poses_on(log_, {"../../evil", "robot1/BODY_POSES", ".hidden", "A-1.b"});
  EXPECT_EQ(extract(options(log_, Extracted::kPoses)).frames, 4);
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(out_))
    names.push_back(file.path().filename());
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("_.._.._evil.jsonl", "_.hidden.jsonl",
                                                     "robot1_BODY_POSES.jsonl", "A-1.b.jsonl"));
}

TEST_F(Extract, OfPosesDoesNotMixChannelsInAFile) {
  write_poses_on(log_, {"a/b", "a_b"});
  EXPECT_THAT(
      test::error_of<config::UsageError>([&] { extract(options(log_, Extracted::kPoses)); }),
      HasSubstr("'a/b' and 'a_b' would both be a_b.jsonl; choose one with --channel"));
}

TEST_F(Extract, OfPosesLeavesEarlierOnesWhereItFails) {
  write_poses_on(log_, {"a/b"});
  extract(options(log_, Extracted::kPoses));
  const std::vector<char> earlier = bytes_of(out_ + "/a_b.jsonl");
  write_poses_on(log_, {"a/b", "a/b", "a_b"});
  EXPECT_THROW(extract(options(log_, Extracted::kPoses)), config::UsageError);
  EXPECT_EQ(bytes_of(out_ + "/a_b.jsonl"), earlier);
}

TEST_F(Extract, ThatIsInterruptedIsNoSuccess) {
  const std::string in = test::repository_file("logs/nobody.log");
  EXPECT_EXIT(run_interrupted([&] { extract(options(in, Extracted::kImages)); }),
              ::testing::ExitedWithCode(1),
              "log: interrupted; " + out_ + " holds the 0 frames extracted so far\n");
  EXPECT_FALSE(std::filesystem::exists(out_ + "/timestamps.csv"));
  EXPECT_NO_THROW(extract(options(in, Extracted::kImages))) << "it may be done again";
}

/// A log of one frame of poses, whose line has more than 10 kB.
void write_crowd(const std::string& path) {
  BodyPoses crowd;
  crowd.stamp.sensor = "front";
  crowd.persons.resize(100);
  lcm_io::LogWriter log(path);
  log.write(kBegin, "BODY_POSES", lcm_io::to_message(crowd));
  log.close();
}

TEST_F(Extract, ThatIsToldToEndAfterItsLastFrameIsWhole) {
  write_crowd(log_);
  std::filesystem::create_directory(out_);
  EXPECT_EXIT(run_interrupted_by_last_output(out_ + "/BODY_POSES.jsonl",
                                             [this] { extract(options(log_, Extracted::kPoses)); }),
              ::testing::ExitedWithCode(0), "^$");
}

TEST_F(Extract, RefusesAFolderThatHoldsARecording) {
  const ExtractOptions images =
      options(test::repository_file("logs/multi.log"), Extracted::kImages);
  extract(images);
  const std::vector<char> calibration = bytes_of(out_ + "/calibration.yml");
  write_bytes(out_ + "/timestamps.csv", {'m', 'i', 'n', 'e'});
  EXPECT_EQ(test::error_of<config::UsageError>([&] { extract(images); }),
            out_ + ": holds a recording already; choose another folder or delete this one");
  EXPECT_EQ(bytes_of(out_ + "/timestamps.csv").size(), 4U);
  EXPECT_EQ(bytes_of(out_ + "/calibration.yml"), calibration);
}

TEST_F(Extract, RefusesAFolderThatAnotherProcessExtractsInto) {
  // Neither has written timestamps.csv yet, which makes the folder a recording.
  std::filesystem::create_directory(out_);
  const config::FolderLock other(out_);
  EXPECT_EQ(test::error_of<config::UsageError>([&] {
              extract(options(test::repository_file("logs/nobody.log"), Extracted::kImages));
            }),
            out_ + ": is being written by another process; choose another folder");
  EXPECT_TRUE(std::filesystem::is_empty(out_));
}

TEST_F(Extract, OfPosesRefusesAFileThatAnotherProcessWrites) {
  write_ten_frames(log_);
  std::filesystem::create_directory(out_);
  const std::string unfinished = out_ + "/BODY_POSES.jsonl.unfinished";
  const lcm_io::FileLock other(unfinished);
  EXPECT_EQ(test::error_of<config::UsageError>([&] { extract(options(log_, Extracted::kPoses)); }),
            unfinished + ": is being written by another process; choose another file");
}

TEST_F(Extract, OfPosesSaysThatTheDiskIsFull) {
  write_crowd(log_);
  const auto extract_on_a_full_disk = [this] {
    test::let_files_grow_to(10'000);
    run_and_exit([this] { extract(options(log_, Extracted::kPoses)); });
  };
  EXPECT_EXIT(extract_on_a_full_disk(), ::testing::ExitedWithCode(1),
              "log: " + out_ +
                  "/BODY_POSES.jsonl.unfinished: cannot be written \\(File too large\\); make room "
                  "or choose another folder\n");
}

/// A log of two pairs, of which the last picture alone has more than 10 kB.
void write_two_pairs(const std::string& path) {
  lcm_io::LogWriter log(path);
  for (int i = 0; i < 2; ++i) {
    stereo_images_t pair{};
    pair.stamp = poses_of_frame(i).stamp;
    pair.left.encoding = pair.right.encoding = image_t::JPEG;
    pair.left.data.resize(100);
    pair.right.data.resize(i == 0 ? 100 : 20'000);
    for (image_t* image : {&pair.left, &pair.right})
      image->size = static_cast<std::int32_t>(image->data.size());
    log.write(pair.stamp.utime, "STEREO_IMAGES", pair);
  }
  log.close();
}

TEST_F(Extract, OntoAFullDiskLeavesARecordingOfTheFramesSoFar) {
  write_two_pairs(log_);
  const auto extract_onto_a_full_disk = [this] {
    test::let_files_grow_to(10'000);
    run_and_exit([this] { extract(options(log_, Extracted::kImages)); });
  };
  EXPECT_EXIT(extract_onto_a_full_disk(), ::testing::ExitedWithCode(1),
              "log: " + out_ +
                  "/0001000000100000_right.jpg: cannot be written \\(File too large\\); " + out_ +
                  " holds the 1 frames extracted so far\n");
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(out_))
    names.push_back(file.path().filename());
  EXPECT_THAT(names,
              ::testing::UnorderedElementsAre("0001000000000000_left.jpg",
                                              "0001000000000000_right.jpg", "timestamps.csv"));
  const std::vector<char> times = bytes_of(out_ + "/timestamps.csv");
  EXPECT_EQ(std::string(times.begin(), times.end()),
            "name,utime\n0001000000000000,1000000000000\n");
}

TEST_F(Extract, AsksForAFolderWhereAFileIsGiven) {
  const std::string in = test::repository_file("logs/nobody.log");
  ExtractOptions onto_file = options(in, Extracted::kImages);
  onto_file.folder = in;
  EXPECT_EQ(test::error_of<config::UsageError>([&] { extract(onto_file); }),
            in + ": is no folder; give one to FOLDER");
}

TEST_F(Extract, RefusesALogWithNothingOfTheKind) {
  write_ten_frames(log_);
  EXPECT_THROW(extract(options(log_, Extracted::kImages)), config::UsageError);
}

}  // namespace
}  // namespace limbcast::logs
