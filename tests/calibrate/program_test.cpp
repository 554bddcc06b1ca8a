#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <regex>

#include "common/camera/calibration_reader.hpp"
#include "common/camera/calibration_writer.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/calibrate/found_cameras.hpp"
#include "tests/common/run_program.hpp"

namespace limbcast::calibrate {
namespace {

using limbcast::test::Outcome;
using limbcast::test::run_program;
using limbcast::test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

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

std::string numbered(const std::string& stem, std::size_t number) {
  const std::string digits = std::to_string(number);
  return stem + std::string(4 - digits.size(), '0') + digits;
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
  write_pair(folder, picture_of_wall("empty", {640, 480}));
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

TEST(CalibrateProgram, CalibratesFisheyeLensesForTheStereoCamera) {
  const TemporaryFolder folder;
  const Board board = large_board();
  const std::vector<BoardPose> poses = poses_around(board);
  for (std::size_t i = 0; i < poses.size(); i += 2)
    write_pair(folder, render_board(board, poses[i], fisheye_cameras(), numbered("p", i)));
  const TemporaryFolder out;
  const Outcome outcome =
      run_program("limbcast-calibrate", {"--lens", "fisheye", "--square-mm", "50", "--source",
                                         folder.path(), "--output", out / "calibration.yml"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const StereoCalibration found = read_stereo_calibration(out / "calibration.yml");
  expect_found(found, fisheye_cameras());

  const std::vector<std::string> source{"--source", folder.path(), "--calibration",
                                        out / "calibration.yml"};
  std::vector<std::string> check{"check", "--square-mm", "50"};
  check.insert(check.end(), source.begin(), source.end());
  const Outcome checked = run_program("limbcast-calibrate", check);
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  std::vector<std::string> record{"--log", out / "in.log"};
  record.insert(record.end(), source.begin(), source.end());
  ASSERT_EQ(run_program("limbcast-stereo-camera", record).exit_code, 0);
  ASSERT_EQ(run_program("limbcast-log", {"extract", out / "in.log", out / "shots"}).exit_code, 0);
  const StereoCalibration sent = read_stereo_calibration(out / "shots/calibration.yml");
  EXPECT_EQ(sent.left.model, LensModel::kFisheye);
  EXPECT_EQ(sent.right.distortion, found.right.distortion);
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

/// Writes the folder's pairs to in.log.
void record(const TemporaryFolder& folder, const TemporaryFolder& out) {
  write_stereo_calibration(out / "any.yml", true_cameras());
  ASSERT_EQ(run_program("limbcast-stereo-camera",
                        {"--source", folder.path(), "--calibration", out / "any.yml", "--log",
                         out / "in.log", "--jpeg-quality", "0"})
                .exit_code,
            0);
}

TEST(CalibrateProgram, CalibratesFromALogOfAMovingBoard) {
  const TemporaryFolder folder;
  std::size_t number = 0;
  for (GreyPair pair : board_video(12, 2)) {
    pair.name = numbered("frame_", number++);
    write_pair(folder, pair);
  }
  const TemporaryFolder out;
  ASSERT_NO_FATAL_FAILURE(record(folder, out));

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

TEST(CalibrateProgram, HasSeenEnoughThroughFisheyesWhereAllThatTheyLightIsCovered) {
  const Board board = large_board();
  std::vector<BoardPose> poses = poses_in_image_circle(board);
  const std::size_t enough = poses.size();
  for (const BoardPose& pose : varied_poses(board, 2)) poses.push_back(pose);
  const TemporaryFolder folder;
  std::size_t number = 0;
  for (const BoardPose& pose : poses) {
    GreyPair pair = lit_in_image_circle(render_board(board, pose, fisheye_cameras(), ""));
    for (int still = 0; still < 2; ++still) {
      pair.name = numbered("frame_", number++);
      write_pair(folder, pair);
    }
  }
  const TemporaryFolder out;
  ASSERT_NO_FATAL_FAILURE(record(folder, out));

  const Outcome outcome = run_program(
      "limbcast-calibrate", {"--source", out / "in.log", "--lens", "fisheye", "--square-mm", "50",
                             "--output", out / "found.yml", "--picture", out / "report.png"});

  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, Not(HasSubstr("to add:")));
  EXPECT_THAT(outcome.err, HasSubstr("view 15 taken"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("view " + std::to_string(enough + 1) + " taken")));
  expect_found(read_stereo_calibration(out / "found.yml"), fisheye_cameras());
}

TEST(CalibrateProgram, TellsWhyALogOfSingleShotsGivesNoViewsAndWhatToDo) {
  const TemporaryFolder folder;
  write_rendered_pairs(folder);
  const TemporaryFolder out;
  ASSERT_NO_FATAL_FAILURE(record(folder, out));

  const Outcome as_video = run_program("limbcast-calibrate",
                                       {"--source", out / "in.log", "--output", out / "found.yml"});

  EXPECT_EQ(as_video.exit_code, 1);
  EXPECT_THAT(as_video.err,
              HasSubstr("only 0 good views of the board, at least 5 are needed, 15 to 30 are "
                        "better; the others: the board has just come into view (1), the board "
                        "moves (9); hold it still at each place; of a log of single shots give "
                        "the folder that limbcast-log extract writes\n"));
  ASSERT_EQ(run_program("limbcast-log", {"extract", out / "in.log", out / "shots"}).exit_code, 0);
  const Outcome as_shots =
      run_program("limbcast-calibrate", {"--source", out / "shots", "--output", out / "found.yml"});
  EXPECT_EQ(as_shots.exit_code, 0) << as_shots.out << as_shots.err;
  expect_true_cameras(read_stereo_calibration(out / "found.yml"));
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

}  // namespace
}  // namespace limbcast::calibrate
