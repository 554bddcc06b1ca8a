#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <regex>

#include "common/camera/calibration_reader.hpp"
#include "common/camera/calibration_writer.hpp"
#include "common/lcm_io/log_file.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/common/run_program.hpp"

namespace limbcast::calibrate {
namespace {

using limbcast::test::Outcome;
using limbcast::test::run_program;
using limbcast::test::TemporaryFolder;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

/// As cameras give them: coloured JPEG.
void write_pair(const TemporaryFolder& folder, const GreyPair& pair) {
  for (const auto& [grey, side] :
       {std::pair(&pair.left, "_left.jpg"), {&pair.right, "_right.jpg"}}) {
    cv::Mat image;
    cv::cvtColor(*grey, image, cv::COLOR_GRAY2BGR);
    cv::imwrite(folder / (pair.name + side), image);
  }
}

/// Pairs of OpenCV's example under the names that a folder source wants.
void link_example_pairs(const TemporaryFolder& folder) {
  const fs::path data = fs::path(LIMBCAST_DATA_DIR) / "stereo_opencv";
  for (const fs::directory_entry& file : fs::directory_iterator(data)) {
    if (file.path().extension() != ".jpg") continue;
    const std::string stem = file.path().stem().string();
    const std::string number = stem.substr(stem.size() - 2);
    const std::string side = stem.substr(0, stem.size() - 2);
    fs::create_symlink(
        file.path(),
        folder / std::string("pair").append(number).append("_").append(side).append(".jpg"));
  }
}

TEST(CalibrateProgram, CalibratesARealPairOfCameras) {
  if (!fs::exists(fs::path(LIMBCAST_DATA_DIR) / "stereo_opencv"))
    GTEST_SKIP() << LIMBCAST_DATA_DIR << " is absent";
  const TemporaryFolder folder;
  link_example_pairs(folder);
  const TemporaryFolder out;
  const Outcome outcome =
      run_program("limbcast-calibrate", {"--source", folder.path(), "--square-mm", "25", "--output",
                                         out / "calibration.yml", "--picture", out / "report.png"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("13 views"));
  EXPECT_THAT(outcome.out, HasSubstr("to add: show the board in these parts of the left image"));
  const StereoCalibration found = read_stereo_calibration(out / "calibration.yml");
  // An independent calibration of the same corners lies beside the pictures.
  EXPECT_NEAR(found.left.camera.fx, 532.8, 0.003 * 532.8);
  EXPECT_NEAR(found.right.camera.fx, 537.4, 0.006 * 537.4);
  EXPECT_NEAR(baseline_m(found), 3.328 * 0.025, 0.005 * 3.328 * 0.025);
  ASSERT_TRUE(found.rectification);
  EXPECT_FALSE(cv::imread(out / "report.png").empty());
}

void write_rendered_pairs(const TemporaryFolder& folder) {
  const Board board;
  int number = 10;
  for (const BoardPose& pose : varied_poses(board, 10))
    write_pair(folder, render_board(board, pose, true_cameras(), "p" + std::to_string(number++)));
}

TEST(CalibrateProgram, KeepsTheCalibrationWhereThePictureCannotBeWritten) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder folder;
  write_rendered_pairs(folder);
  const TemporaryFolder out;
  fs::create_symlink("/dev/full", out / "report.png");
  const Outcome outcome =
      run_program("limbcast-calibrate", {"--source", folder.path(), "--output",
                                         out / "calibration.yml", "--picture", out / "report.png"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("report.png: cannot be written (No space left on device)"));
  EXPECT_THAT(outcome.out, HasSubstr("written: " + (out / "calibration.yml")));
  EXPECT_NO_THROW(read_stereo_calibration(out / "calibration.yml"));
}

TEST(CalibrateProgram, CalibratesRenderedCamerasAndNamesBadPairs) {
  const TemporaryFolder folder;
  write_rendered_pairs(folder);
  write_pair(folder, {"empty", cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)),
                      cv::Mat(480, 640, CV_8UC1, cv::Scalar(90))});
  const TemporaryFolder out;
  const Outcome outcome = run_program(
      "limbcast-calibrate", {"--source", folder.path(), "--output", out / "calibration.yml"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out,
              ::testing::ContainsRegex("empty +rejected: board not found in the left"));
  const StereoCalibration found = read_stereo_calibration(out / "calibration.yml");
  EXPECT_NEAR(found.left.camera.fx, 531.2, 0.003 * 531.2);
  EXPECT_NEAR(found.T.norm(), true_cameras().T.norm(), 0.005 * 0.12);
}

/// Pairs as a video shows them: a board that is held still at one place after the other; the last
/// picture is blurred by motion.
std::vector<GreyPair> board_video(int places, int frames_still) {
  std::vector<GreyPair> frames;
  for (const BoardPose& pose : varied_poses({}, places)) {
    GreyPair pair = render_board({}, pose, true_cameras(), "");
    for (int i = 0; i < frames_still; ++i) frames.push_back(pair);
  }
  for (cv::Mat* image : {&frames.back().left, &frames.back().right}) {
    cv::Mat blurred;  // the pixels are those of the frame before
    cv::blur(*image, blurred, {25, 1});
    *image = blurred;
  }
  return frames;
}

void expect_true_cameras(const StereoCalibration& found) {
  EXPECT_NEAR(found.left.camera.fx, 531.2, 0.003 * 531.2);
  EXPECT_NEAR(found.right.camera.fx, 529.4, 0.003 * 529.4);
  EXPECT_NEAR(found.T.norm(), true_cameras().T.norm(), 0.005 * 0.12);
}

std::string numbered(const std::string& stem, std::size_t number) {
  const std::string digits = std::to_string(number);
  return stem + std::string(4 - digits.size(), '0') + digits;
}

TEST(CalibrateProgram, CalibratesFromALogOfAMovingBoard) {
  const TemporaryFolder folder;
  std::size_t number = 0;
  for (GreyPair pair : board_video(12, 2)) {
    pair.name = numbered("frame_", number++);
    write_pair(folder, pair);
  }
  const TemporaryFolder out;
  write_stereo_calibration(out / "any.yml", true_cameras());
  ASSERT_EQ(run_program("limbcast-stereo-camera",
                        {"--source", folder.path(), "--calibration", out / "any.yml", "--log",
                         out / "in.log", "--jpeg-quality", "0"})
                .exit_code,
            0);

  const Outcome outcome = run_program("limbcast-calibrate",
                                      {"--source", out / "in.log", "--output", out / "found.yml"});

  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  // Of each place the second frame, when the board is known to stand still: 0.1 s, 0.3 s, ...
  const std::regex taken("([0-9]+): view [0-9]+ taken");
  int views = 0;
  for (std::sregex_iterator view(outcome.err.begin(), outcome.err.end(), taken), end; view != end;
       ++view, ++views)
    EXPECT_EQ(std::stol((*view)[1]) % 200'000, 100'000) << view->str();
  EXPECT_GE(views, 8);
  expect_true_cameras(read_stereo_calibration(out / "found.yml"));
}

TEST(CalibrateProgram, RefusesPicturesWithoutBoard) {
  const TemporaryFolder folder;
  write_pair(folder, {"a", cv::Mat(48, 64, CV_8UC1, cv::Scalar(90)),
                      cv::Mat(48, 64, CV_8UC1, cv::Scalar(90))});
  const Outcome outcome = run_program(
      "limbcast-calibrate", {"--source", folder.path(), "--output", folder / "calibration.yml"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("only 0 good views of the board"));
  EXPECT_FALSE(fs::exists(folder / "calibration.yml"));
}

TEST(CalibrateProgram, ChecksACalibrationOnABoard) {
  const TemporaryFolder folder;
  const Board board;
  const std::vector<BoardPose> poses = varied_poses(board, 2);
  write_pair(folder, render_board(board, poses[0], true_cameras(), "a"));
  write_pair(folder, render_board(board, poses[1], true_cameras(), "b"));
  const TemporaryFolder out;
  StereoCalibration cameras = true_cameras();
  write_stereo_calibration(out / "good.yml", cameras);
  const Outcome good = run_program("limbcast-calibrate", {"check", "--source", folder.path(),
                                                          "--calibration", out / "good.yml"});
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_THAT(good.out, HasSubstr("2 with a board"));

  // One camera nods by a quarter of a degree: 531 px * 0.0044 = 2.3 px.
  cameras.R = Eigen::AngleAxisd(0.0044, Eigen::Vector3d::UnitX()) * cameras.R;
  write_stereo_calibration(out / "bad.yml", cameras);
  const Outcome bad = run_program(
      "limbcast-calibrate", {"check", "--source", folder.path(), "--calibration", out / "bad.yml"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.out, HasSubstr("bad: the median epipolar error is 2."));

  cameras = true_cameras();
  cameras.T *= 1.1;
  write_stereo_calibration(out / "long.yml", cameras);
  const Outcome too_long = run_program("limbcast-calibrate", {"check", "--source", folder.path(),
                                                              "--calibration", out / "long.yml"});
  EXPECT_EQ(too_long.exit_code, 1);
  EXPECT_THAT(too_long.out, ::testing::ContainsRegex("lengths on the board are off by .(9|10)"));
}

TEST(CalibrateProgram, LeavesMalformedMessagesOfALogOut) {
  const TemporaryFolder folder;
  lcm_io::LogReader in(std::string(LIMBCAST_SOURCE_DIR) + "/logs/nobody.log");
  lcm_io::LogWriter out(folder / "in.log");
  int num_pairs = 0, num_calibrations = 0;
  while (auto event = in.next()) {
    // Of eight pairs every other one, and the first calibration.
    const bool malformed = event->channel == "STEREO_IMAGES"        ? num_pairs++ % 2 == 0
                           : event->channel == "STEREO_CALIBRATION" ? num_calibrations++ == 0
                                                                    : false;
    if (malformed) event->data.resize(event->data.size() / 2);
    out.write(*event);
  }
  out.close();
  const Outcome outcome =
      run_program("limbcast-calibrate", {"check", "--source", folder / "in.log"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("4 pairs"));
  for (const char* channel : {"STEREO_CALIBRATION", "STEREO_IMAGES"})
    EXPECT_THAT(outcome.err, HasSubstr("in.log: malformed messages on " + std::string(channel) +
                                       " are left out; the first: not a message of this type"));
}

TEST(CalibrateProgram, SaysThatALogHoldsNoPictures) {
  const TemporaryFolder folder;
  folder.write("empty.log", "");
  lcm_io::LogWriter other(folder / "other.log");
  other.write({1, "OTHER", {1, 2, 3}, 0});
  other.close();
  for (const auto& [log, reason] :
       {std::pair("empty.log", "is empty; was the logger running?"),
        {"other.log", "holds no pairs on STEREO_IMAGES; was limbcast-stereo-camera running?"}}) {
    const Outcome outcome = run_program("limbcast-calibrate", {"check", "--source", folder / log});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "limbcast-calibrate: " + folder / log + ": " + reason + "\n");
  }
}

TEST(CalibrateProgram, NamesAPairThatIsNotOfTheCalibrationsSize) {
  const TemporaryFolder folder;
  write_pair(folder, {"a", cv::Mat(48, 64, CV_8UC1, cv::Scalar(90)),
                      cv::Mat(48, 64, CV_8UC1, cv::Scalar(90))});
  const std::string file = folder / "any.yml";
  write_stereo_calibration(file, true_cameras());
  for (std::vector<std::string> arguments :
       {std::vector<std::string>{"check"}, {"mounting", "--output", folder / "out.yml"}}) {
    arguments.insert(arguments.end(), {"--source", folder.path(), "--calibration", file});
    const Outcome outcome = run_program("limbcast-calibrate", arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err,
              "limbcast-calibrate: a: the left image is 64x48, the calibration is for 640x480; "
              "give the calibration of this camera and image size\n");
  }
}

TEST(CalibrateProgram, FindsNoBoardInPicturesOfAFewPixels) {
  for (const cv::Size& size : {cv::Size(1, 1), {8, 8}, {1000, 2}, {2, 1000}}) {
    const TemporaryFolder folder;
    const cv::Mat dot(size, CV_8UC1, cv::Scalar(90));
    write_pair(folder, {"a", dot, dot});
    for (const char* kind : {"chessboard", "circles", "charuco"}) {
      const Outcome outcome =
          run_program("limbcast-calibrate",
                      {"--source", folder.path(), "--board", kind, "--output", folder / "c.yml"});
      EXPECT_EQ(outcome.exit_code, 1);
      EXPECT_THAT(outcome.out, ::testing::ContainsRegex("a +rejected: board not found"));
    }
  }
}

TEST(CalibrateProgram, ExplainsWrongUsage) {
  const Outcome no_output = run_program("limbcast-calibrate", {"--source", "/nowhere"});
  EXPECT_EQ(no_output.exit_code, 2);
  EXPECT_THAT(no_output.err, HasSubstr("--output is missing"));
  const Outcome no_folder =
      run_program("limbcast-calibrate", {"--source", "/nowhere", "--output", "c.yml"});
  EXPECT_EQ(no_folder.exit_code, 2);
  EXPECT_THAT(no_folder.err, HasSubstr("/nowhere"));
  const Outcome no_log = run_program("limbcast-calibrate", {"check", "--source", "/nowhere.log"});
  EXPECT_EQ(no_log.exit_code, 2);
  EXPECT_THAT(no_log.err, HasSubstr("/nowhere.log: does not exist"));
  const TemporaryFolder pictures;
  const Outcome live_options = run_program(
      "limbcast-calibrate", {"--source", pictures.path(), "--gain", "3", "--output", "c.yml"});
  EXPECT_EQ(live_options.exit_code, 2);
  EXPECT_THAT(live_options.err, HasSubstr(": is a recording; leave out gain"));
}

TEST(CalibrateProgram, NamesItsCommandsWhereOneIsUnknown) {
  const Outcome outcome = run_program("limbcast-calibrate", {"chek", "--source", "/nowhere"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "limbcast-calibrate: command line: 'chek' is no command; use board, check or mounting, "
            "or options alone to calibrate, see limbcast-calibrate --help\n");
}

TEST(CalibrateProgram, RefusesToWriteOverAPictureOfItsSource) {
  const TemporaryFolder folder;
  const std::string picture = folder.write("01_left.jpg", "a picture");
  folder.write("calibration.yml", "old");
  const auto refusal_of = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--source", folder.path()});
    const Outcome outcome = run_program("limbcast-calibrate", arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  const std::string is_read = picture + ": is what is read; choose another ";
  EXPECT_THAT(refusal_of({"--output", picture}), HasSubstr(is_read + "--output"));
  EXPECT_THAT(refusal_of({"mounting", "--output", picture}), HasSubstr(is_read + "--output"));
  EXPECT_THAT(refusal_of({"--output", folder / "calibration.yml", "--picture", picture}),
              HasSubstr(is_read + "--picture"));
  // Its calibration may be written anew, so that what is said next is that a picture is missing.
  EXPECT_THAT(refusal_of({"--output", folder / "calibration.yml"}),
              ::testing::Not(HasSubstr("is what is read")));
}

TEST(CalibrateProgram, RefusesFilesThatItCannotWriteBeforeItLooksAtPictures) {
  const auto expect_refusal = [&](std::vector<std::string> arguments, const std::string& text) {
    arguments.insert(arguments.end(), {"--source", "/nowhere"});
    const Outcome outcome = run_program("limbcast-calibrate", arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "limbcast-calibrate: " + text + "\n");
  };
  expect_refusal({"--output", "/none/c.yml"},
                 "/none/c.yml: there is no folder /none; make it or choose another --output");
  expect_refusal({"--output", "c.yml", "--picture", "/none/c.png"},
                 "/none/c.png: there is no folder /none; make it or choose another --picture");
  expect_refusal({"--output", "c.yml", "--picture", "c.odt"},
                 "c.odt: no picture format has this ending; use .png");
  expect_refusal({"mounting", "--output", "/none/c.yml"},
                 "/none/c.yml: there is no folder /none; make it or choose another --output");
}

}  // namespace
}  // namespace limbcast::calibrate
