#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <csignal>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/camera/calibration_reader.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/piped_camera.hpp"

namespace limbcast::test {
namespace {

using calibrate::Board;
using calibrate::BoardPose;
using calibrate::GreyPair;
using calibrate::true_cameras;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

const cv::Size kBothImages(1280, 480);

/// What the camera gives while the board is held there: both images side by side.
cv::Mat picture_of(const GreyPair& pair) {
  cv::Mat both;
  cv::hconcat(pair.left, pair.right, both);
  return both;
}

/// limbcast-calibrate watching a camera, before which the test holds rendered boards. The test goes
/// on when the program says what it waits for, as people do, so it works at any speed.
class LiveCalibration : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_gstreamer()) GTEST_SKIP() << "gstreamer1.0-plugins-base and -good are absent";
    camera_.emplace(folder_ + "/camera", kBothImages);
  }
  void start(int views) {
    program_.emplace(
        std::vector<std::string>{program("limbcast-calibrate"), "--source", camera_->source(),
                                 "--views", std::to_string(views), "--output", output_},
        folder_ + "/said.txt");
  }
  bool said(const std::string& words) const {
    return program_->output().find(words) != std::string::npos;
  }
  /// Places at which the board is found, so that holding it there for long enough gives a view.
  static std::vector<GreyPair> pictures(int count) {
    const Board board;
    std::vector<GreyPair> found;
    for (const BoardPose& pose : calibrate::varied_poses(board, 2 * count)) {
      GreyPair pair = calibrate::render_board(board, pose, true_cameras(), "");
      const auto seen = [&](const cv::Mat& image) {
        return glimpse_board(image, board) && find_board(image, board);
      };
      if (static_cast<int>(found.size()) < count && seen(pair.left) && seen(pair.right))
        found.push_back(std::move(pair));
    }
    return found;
  }
  /// Shows the picture until the program says so; false: it ended before.
  bool show_until(const GreyPair& pair, const std::string& words) {
    const cv::Mat picture = picture_of(pair);
    while (!said(words)) {
      if (!camera_->give(picture, *program_)) return said(words);
    }
    return true;
  }
  /// Shows nothing more until the program says so; false: it ended before.
  bool wait_until(const std::string& words) {
    constexpr int kLook_ms = 100;
    while (!said(words)) {
      if (!program_->running()) return said(words);
      poll(nullptr, 0, kLook_ms);
    }
    return true;
  }

  std::string folder_ = temporary_folder("live");
  std::string output_ = folder_ + "/found.yml";
  std::optional<PipedCamera> camera_;
  std::optional<ChildProcess> program_;
};

TEST_F(LiveCalibration, EndsWithACalibrationThatTheCameraReads) {
  constexpr int kViews = 10;
  const std::vector<GreyPair> shown = pictures(kViews);
  ASSERT_EQ(shown.size(), kViews);
  start(kViews);

  for (int i = 0; i < kViews; ++i)
    ASSERT_TRUE(show_until(shown[i], "view " + std::to_string(i + 1) + " taken"))
        << program_->output();

  EXPECT_EQ(program_->wait(), 0) << program_->output();
  EXPECT_THAT(program_->output(), HasSubstr("show the board in these parts of the left image"));
  const StereoCalibration found = read_stereo_calibration(output_);
  EXPECT_NEAR(found.left.camera.fx, 531.2, 0.003 * 531.2);
  EXPECT_NEAR(found.right.camera.fx, 529.4, 0.003 * 529.4);
  EXPECT_NEAR(found.T.norm(), true_cameras().T.norm(), 0.005 * 0.12);

  const std::string pairs = temporary_folder("pairs");
  cv::imwrite(pairs + "/a_left.png", shown[0].left);
  cv::imwrite(pairs + "/a_right.png", shown[0].right);
  const RunResult camera = run({program("limbcast-stereo-camera"), "--source", pairs,
                                "--calibration", output_, "--log", folder_ + "/in.log"});
  EXPECT_EQ(camera.exit_code, 0) << camera.output;
}

TEST_F(LiveCalibration, EndsWhereThePipelineCannotPlay) {
  const RunResult result =
      run({program("limbcast-calibrate"), "--source", "gst:nonsense", "--output", output_});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.output, HasSubstr("gst:nonsense: no element \"nonsense\""));
}

TEST_F(LiveCalibration, TellsOfAStallAndWritesNothingWhereItIsToldToEnd) {
  const std::vector<GreyPair> shown = pictures(1);
  ASSERT_EQ(shown.size(), 1U);
  start(8);
  ASSERT_TRUE(show_until(shown[0], "view 1 taken")) << program_->output();
  ASSERT_TRUE(wait_until("stalled, no frame for 2000 ms")) << program_->output();

  program_->signal(SIGINT);

  EXPECT_EQ(program_->wait(), 1);
  EXPECT_THAT(program_->output(), HasSubstr("told to end; nothing is written"));
  for (const fs::directory_entry& file : fs::directory_iterator(folder_))
    EXPECT_THAT(file.path().filename(), ::testing::AnyOf("camera", "said.txt"));
}

}  // namespace
}  // namespace limbcast::test
