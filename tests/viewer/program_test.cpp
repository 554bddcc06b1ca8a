#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <thread>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "tests/common/run_program.hpp"
#include "tests/support/child_process.hpp"
#include "tests/viewer/scene.hpp"

namespace limbcast::viewer {
namespace {

using limbcast::test::Outcome;
using limbcast::test::run_program;
using limbcast::test::TemporaryFolder;
using ::testing::HasSubstr;

Outcome view(const std::vector<std::string>& arguments) {
  return run_program("limbcast-viewer", arguments);
}

void write_log(const std::string& path, int num_frames, bool with_clouds) {
  lcm_io::LogWriter log(path);
  for (int i = 1; i <= num_frames; ++i) {
    if (with_clouds) log.write(i, "POINT_CLOUD", lcm_io::to_message(wall(i)));
    log.write(i, "BODY_POSES", lcm_io::to_message(pointing_arm(i)));
  }
  log.close();
}

std::size_t num_files(const std::string& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    count += entry.is_regular_file() ? 1 : 0;
  return count;
}

TEST(ViewerProgram, WritesEachPictureAndASheet) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 3, true);
  const Outcome outcome = view({folder / "out.log", "--png", folder / "pictures"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(num_files(folder / "pictures"), 3U * 8U);
  const cv::Mat picture = cv::imread(folder / "pictures/frame_00002_skeleton.png");
  ASSERT_EQ(picture.size(), cv::Size(160, 120));
  EXPECT_GT(picture.at<cv::Vec3b>(60, 100)[0], 200);
}

TEST(ViewerProgram, DrawsEveryNthFrameUpToAMaximum) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 9, true);
  const Outcome outcome =
      view({folder / "out.log", "--png", folder / "pictures", "--every", "3", "--max", "2"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(num_files(folder / "pictures"), 2U * 8U);
  EXPECT_TRUE(std::filesystem::exists(folder / "pictures/frame_00003_sheet.png"));
}

TEST(ViewerProgram, LooksFromWhereItIsTold) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 1, true);
  const auto scene = [&folder](const std::vector<std::string>& from) {
    std::vector<std::string> arguments = {folder / "out.log", "--png", folder / "pictures"};
    arguments.insert(arguments.end(), from.begin(), from.end());
    EXPECT_EQ(view(arguments).exit_code, 0);
    return cv::imread(folder / "pictures/frame_00000_scene.png");
  };
  const auto differ = [](const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b) > 0.0; };
  const cv::Mat by_default = scene({});
  EXPECT_FALSE(differ(by_default, scene({"--azimuth-deg", "65", "--elevation-deg", "10"})));
  EXPECT_TRUE(differ(by_default, scene({"--azimuth-deg", "-65"})));
  EXPECT_TRUE(differ(by_default, scene({"--elevation-deg", "-10"})));
  EXPECT_TRUE(differ(by_default, scene({"--zoom", "2"})));
  EXPECT_EQ(view({folder / "out.log", "--zoom", "0"}).exit_code, 2);
}

TEST(ViewerProgram, DrawsPosesOfALogWithoutClouds) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 1, false);
  const Outcome outcome = view({folder / "out.log", "--png", folder / "pictures"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(num_files(folder / "pictures"), 8U);
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

double num_video_frames(const std::string& path) {
  return cv::VideoCapture(path).get(cv::CAP_PROP_FRAME_COUNT);
}

TEST(ViewerProgram, WritesAVideo) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 2, true);
  for (const std::string name : {"out.AVI", "out.mp4"}) {
    const Outcome outcome = view({folder / "out.log", "--video", folder / name});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(num_video_frames(folder / name), 2.0);
  }
  EXPECT_EQ(num_files(folder.path()), 3U) << "nothing else is left";
}

TEST(ViewerProgram, FailsWhereTheDiskTakesOnlyAPartOfTheVideo) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 2, true);
  for (const std::string name : {"out.avi", "out.mp4"}) {
    folder.write(name, "earlier");
    // Files of at most 8 blocks (4 kB), less than a sheet; the signal is ignored, so that writing
    // fails as on a full disk.
    const auto run =
        test::run({"/bin/sh", "-c", R"(trap '' XFSZ; ulimit -f 8; exec "$@")", "sh",
                   test::program("limbcast-viewer"), folder / "out.log", "--video", folder / name});
    EXPECT_EQ(run.exit_code, 1) << run.output;
    EXPECT_EQ(run.output, "limbcast-viewer: " + folder / name +
                              ": cannot be written to its end; is the disk full?\n");
    EXPECT_EQ(bytes_of(folder / name), "earlier");
  }
}

TEST(ViewerProgram, FailsInOneLineWhereTheDiskTakesNothingOfTheVideo) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 2, true);
  for (const std::string name : {"out.avi", "out.mp4"}) {
    // What the program says goes to a pipe, as files take no byte.
    const auto run = test::run(
        {"/bin/sh", "-c",
         R"(((trap '' XFSZ; ulimit -f 0; exec "$@") 2>&1; echo "exit code $?") | cat)", "sh",
         test::program("limbcast-viewer"), folder / "out.log", "--video", folder / name});
    EXPECT_THAT(run.output,
                ::testing::MatchesRegex("limbcast-viewer: " + folder / name +
                                        ": cannot be written[^\n]*; is the disk full\\?\n"
                                        "exit code 1\n"));
    EXPECT_FALSE(std::filesystem::exists(folder / name));
  }
}

TEST(ViewerProgram, FailsWhereItIsInterrupted) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 2000, true);
  test::ChildProcess viewer(
      {test::program("limbcast-viewer"), folder / "out.log", "--png", folder / "pictures"},
      folder / "said");
  while (viewer.running() && !std::filesystem::exists(folder / "pictures/frame_00000_sheet.png"))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  viewer.signal(SIGINT);
  EXPECT_EQ(viewer.wait(), 1);
  EXPECT_THAT(viewer.output(), HasSubstr("limbcast-viewer: interrupted: "));
}

TEST(ViewerProgram, LeavesAnEarlierVideoWhereItIsInterrupted) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 2000, true);
  folder.write("out.avi", "earlier");
  const std::string unfinished = folder / "out.avi.unfinished.avi";
  test::ChildProcess viewer(
      {test::program("limbcast-viewer"), folder / "out.log", "--video", folder / "out.avi"},
      folder / "said");
  while (viewer.running() && !std::filesystem::exists(unfinished))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  viewer.signal(SIGINT);
  EXPECT_EQ(viewer.wait(), 1);
  EXPECT_THAT(viewer.output(),
              HasSubstr(" of 2000 frames; " + unfinished + " holds what was drawn so far\n"));
  EXPECT_EQ(bytes_of(folder / "out.avi"), "earlier");
  EXPECT_GT(num_video_frames(unfinished), 0.0) << "it is a video as far as it goes";
}

TEST(ViewerProgram, RefusesAVideoThatAnotherProcessWrites) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 1, true);
  const lcm_io::FileLock other(folder / "out.avi.unfinished.avi");
  const Outcome outcome = view({folder / "out.log", "--video", folder / "out.avi"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "limbcast-viewer: " + folder /
                                                   "out.avi.unfinished.avi: is being written "
                                                   "by another process; choose another file\n");
}

TEST(ViewerProgram, MissesAVideoForWhichNoFrameCame) {
  const TemporaryFolder folder;
  const std::string video = folder / "out.avi";
  test::ChildProcess viewer(
      {test::program("limbcast-viewer"), "--lcm-url", "memq://", "--video", video},
      folder / "said");
  while (viewer.running() && viewer.output().empty())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  viewer.signal(SIGINT);
  EXPECT_EQ(viewer.wait(), 1);
  EXPECT_THAT(viewer.output(), HasSubstr(video + ": was not written, as no frame came\n"));
}

TEST(ViewerProgram, RefusesALogThatHasPosesOnOtherChannelsOnly) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 1, true);
  const Outcome outcome =
      view({folder / "out.log", "--poses-channel", "TRACKED_POSES", "--png", folder / "pictures"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "limbcast-viewer: " + folder / "out.log" +
                             ": holds no poses on TRACKED_POSES but on BODY_POSES; choose such a "
                             "channel, or limbcast-replay adds them (tracked ones with "
                             "--tracker)\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "pictures"));
}

TEST(ViewerProgram, DrawsCloudsAloneWithAWarning) {
  const TemporaryFolder folder;
  lcm_io::LogWriter log(folder / "out.log");
  log.write(1, "POINT_CLOUD", lcm_io::to_message(wall(1)));
  log.close();
  const Outcome outcome = view({folder / "out.log", "--png", folder / "pictures"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("holds no poses on BODY_POSES; limbcast-replay adds them"));
  EXPECT_TRUE(std::filesystem::exists(folder / "pictures/frame_00000_sheet.png"));
}

TEST(ViewerProgram, SaysWhenThereIsNothingToDraw) {
  const TemporaryFolder folder;
  lcm_io::LogWriter log(folder / "out.log");
  log.write(1, "GROUND_TRUTH", lcm_io::to_message(pointing_arm()));
  log.close();
  const Outcome outcome = view({folder / "out.log", "--png", folder / "pictures"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("holds nothing to draw on POINT_CLOUD, SEGMENTS or BODY_POSES; "
                        "limbcast-replay adds it"));
}

TEST(ViewerProgram, TellsInOneLineThatTheDisplayDoesNotAnswer) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 1, true);
  test::ChildProcess viewer({test::program("limbcast-viewer"), folder / "out.log"},
                            folder / "err.txt", {"DISPLAY=/nowhere:1"});
  EXPECT_EQ(viewer.wait(), 2);
  EXPECT_EQ(viewer.output(),
            "limbcast-viewer: the display does not answer, check DISPLAY; write files with --png "
            "DIR or --video FILE\n");
}

TEST(ViewerProgram, RefusesWhatIsNoLog) {
  const TemporaryFolder folder;
  folder.write("text.log", "no log at all, only words, and enough of them for a header");
  for (const std::string& log : {folder / "text.log", folder / "missing.log"}) {
    const Outcome outcome = view({log, "--png", folder / "pictures"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(log));
  }
}

TEST(ViewerProgram, RefusesOutputsItCannotWrite) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", 1, true);
  folder.write("file", "");
  EXPECT_EQ(view({folder / "out.log", "--png", folder / "file"}).exit_code, 2);
  EXPECT_EQ(view({folder / "out.log", "--video", folder / "out.gif"}).exit_code, 2);
  EXPECT_EQ(view({folder / "out.log", "--video", folder / "none/out.avi"}).exit_code, 2);
  std::filesystem::create_symlink(folder / "out.log", folder / "out.avi");
  EXPECT_THAT(view({folder / "out.log", "--video", folder / "out.avi"}).err,
              HasSubstr("is what is read; choose another --video"));
}

}  // namespace
}  // namespace limbcast::viewer
