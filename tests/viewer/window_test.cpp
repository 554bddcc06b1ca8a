#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "tests/support/virtual_display.hpp"
#include "tests/viewer/scene.hpp"

namespace limbcast::viewer {
namespace {

/// A log whose frames differ in the brightness of the wall that they show.
constexpr int kFrames = 30;
std::uint8_t brightness(int frame) { return static_cast<std::uint8_t>(20 + 7 * frame); }

const cv::Size kSize(960, 420);

class ViewerWindow : public ::testing::Test {
 protected:
  ViewerWindow() {
    if (!test::VirtualDisplay::available()) return;
    display_ = std::make_unique<test::VirtualDisplay>();
    write_log();
    // So slow that a frame changes by what the test does alone.
    viewer_ = std::make_unique<test::ChildProcess>(
        std::vector<std::string>{test::program("limbcast-viewer"), folder_ + "/out.log", "--rate",
                                 "0.1", "--azimuth-deg", "0", "--elevation-deg", "0"},
        folder_ + "/viewer.txt", std::vector<std::string>{display_->variable()});
    window_ = display_->window("limbcast", *viewer_);
  }
  void SetUp() override {
    if (!display_) GTEST_SKIP() << "Xvfb, xdotool or ImageMagick is missing";
    ASSERT_FALSE(window_.empty()) << viewer_->output();
    display_->show(window_, kSize);
  }
  void write_log() const {
    lcm_io::LogWriter log(folder_ + "/out.log");
    for (int i = 0; i < kFrames; ++i) {
      Cloud cloud = wall(i + 1);
      cloud.colors.assign(cloud.points_m.size(), Bgr{brightness(i), brightness(i), brightness(i)});
      log.write(i, "POINT_CLOUD", lcm_io::to_message(cloud));
      log.write(i, "BODY_POSES", lcm_io::to_message(pointing_arm(i + 1)));
    }
    log.close();
  }
  bool shows(int frame) const {
    // Within the first picture of the sheet: the wall alone.
    const cv::Rect part(kSize.width / 16, kSize.height / 4, 20, 20);
    return std::abs(cv::mean(display_->screenshot()(part))[0] - brightness(frame)) < 2.0;
  }
  /// Looks until the window shows the frame, but not for ever.
  bool comes_to_show(int frame) const {
    constexpr int kLooks = 40;
    for (int i = 0; i < kLooks; ++i)
      if (shows(frame)) return true;
    return false;
  }
  // OpenCV forgets a key that comes while it draws; then it is pressed again.
  static constexpr int kPresses = 5;
  bool shows_after(const std::string& key, int frame) const {
    for (int i = 0; i < kPresses; ++i) {
      display_->press(window_, key);
      if (comes_to_show(frame)) return true;
    }
    return false;
  }

  /// The box around the orange of the arm in a part of the window.
  cv::Rect arm_in(const cv::Rect& part) const {
    cv::Mat1b orange;
    cv::inRange(display_->screenshot()(part), cv::Scalar(0, 60, 180), cv::Scalar(110, 160, 255),
                orange);
    return cv::boundingRect(orange);
  }
  bool arm_is(int width_px, const cv::Rect& part) const {
    constexpr int kTolerance_px = 5;
    return std::abs(arm_in(part).width - width_px) <= kTolerance_px;
  }
  /// Looks until the arm in the part is so wide, but not for ever.
  bool arm_comes_to_be(int width_px, const cv::Rect& part) const {
    constexpr int kLooks = 40;
    for (int i = 0; i < kLooks; ++i)
      if (arm_is(width_px, part)) return true;
    return false;
  }
  bool arm_comes_to_be_after(const std::string& key, int width_px, const cv::Rect& part) const {
    for (int i = 0; i < kPresses; ++i) {
      display_->press(window_, key);
      if (arm_comes_to_be(width_px, part)) return true;
    }
    return false;
  }
  /// How often a key that turns by a step is pressed until the arm is so wide; at most `most`.
  int presses_until_arm_is(const std::string& key, int width_px, const cv::Rect& part,
                           int most) const {
    int presses = 0;
    while (presses < most && !arm_is(width_px, part)) {
      display_->press(window_, key);
      ++presses;
    }
    return presses;
  }

  const std::string folder_ = test::temporary_folder("viewer_window");
  std::unique_ptr<test::VirtualDisplay> display_;
  std::unique_ptr<test::ChildProcess> viewer_;
  std::string window_;
};

TEST_F(ViewerWindow, StepsAndJumpsThroughALogByKeys) {
  ASSERT_TRUE(comes_to_show(0)) << viewer_->output();
  EXPECT_TRUE(shows_after("s", 1));
  EXPECT_TRUE(shows_after("Right", 2));
  EXPECT_TRUE(shows_after("Left", 1));
  EXPECT_TRUE(shows_after("a", 0));
  EXPECT_TRUE(shows_after("Next", 10));
  EXPECT_TRUE(shows_after("Prior", 0));
  EXPECT_TRUE(shows_after("End", kFrames - 1));
  EXPECT_TRUE(shows_after("Home", 0));
  while (viewer_->running()) display_->press(window_, "q");
  EXPECT_EQ(viewer_->wait(), 0) << viewer_->output();
}

TEST_F(ViewerWindow, TurnsWithTheMouseAndByKeys) {
  // The sixth picture shows the scene; the slider is below.
  const cv::Rect whole(0, 0, 960, 360), scene(240, 180, 240, 180);
  ASSERT_TRUE(comes_to_show(0)) << viewer_->output();
  const int across_px = arm_in(scene).width;
  ASSERT_GT(across_px, 30);

  // A quarter of the window: a quarter turn, after which the arm points to the eye.
  display_->drag({500, 200}, {500 + whole.width / 4, 200});
  EXPECT_TRUE(arm_comes_to_be(0, scene));
  EXPECT_TRUE(arm_comes_to_be_after("r", across_px, scene));
  // Steps of 5 degrees: half as wide after twelve, give or take one. Keys may be forgotten, none
  // counts twice.
  constexpr int kLeast = 10, kMost = 60;
  const int presses = presses_until_arm_is("l", across_px / 2, scene, kMost);
  EXPECT_GE(presses, kLeast);
  EXPECT_LT(presses, kMost);
  EXPECT_LT(presses_until_arm_is("j", across_px, scene, kMost), kMost);
  EXPECT_TRUE(arm_comes_to_be_after("r", across_px, scene));

  // Twice as high as in the sheet.
  EXPECT_TRUE(arm_comes_to_be_after("v", 2 * across_px, whole));
  EXPECT_TRUE(arm_comes_to_be_after("minus", cvRound(2 * across_px / 1.2), whole));
}

TEST_F(ViewerWindow, GoesNearerWithTheWheelAndMagnifiesNoPixels) {
  const cv::Rect scene(240, 180, 240, 180);
  ASSERT_TRUE(comes_to_show(0)) << viewer_->output();
  const int across_px = arm_in(scene).width;
  ASSERT_GT(across_px, 30);

  display_->turn_wheel({360, 270}, true);
  EXPECT_TRUE(arm_comes_to_be(cvRound(1.2 * across_px), scene));
  // Were the sheet magnified too, the first picture would be elsewhere.
  EXPECT_TRUE(shows(0));
  display_->turn_wheel({360, 270}, false);
  EXPECT_TRUE(arm_comes_to_be(across_px, scene));
}

}  // namespace
}  // namespace limbcast::viewer
