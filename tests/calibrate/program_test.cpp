#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "common/camera/calibration_io.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/common/run_program.hpp"

namespace limbcast::calibrate {
namespace {

using limbcast::testing::Outcome;
using limbcast::testing::run_program;
using limbcast::testing::TemporaryFolder;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

void write_pair(const TemporaryFolder& folder, const GreyPair& pair) {
  cv::imwrite(folder / (pair.name + "_left.png"), pair.left);
  cv::imwrite(folder / (pair.name + "_right.png"), pair.right);
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

TEST(CalibrateProgram, CalibratesRenderedCamerasAndNamesBadPairs) {
  const TemporaryFolder folder;
  const Board board;
  for (const BoardPose& pose : varied_poses(board, 10)) {
    static int number = 10;
    write_pair(folder, render_board(board, pose, true_cameras(), "p" + std::to_string(number++)));
  }
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

TEST(CalibrateProgram, ExplainsWrongUsage) {
  const Outcome no_output = run_program("limbcast-calibrate", {"--source", "/nowhere"});
  EXPECT_EQ(no_output.exit_code, 2);
  EXPECT_THAT(no_output.err, HasSubstr("--output is missing"));
  const Outcome no_folder =
      run_program("limbcast-calibrate", {"--source", "/nowhere", "--output", "c.yml"});
  EXPECT_EQ(no_folder.exit_code, 2);
  EXPECT_THAT(no_folder.err, HasSubstr("/nowhere"));
}

}  // namespace
}  // namespace limbcast::calibrate
