#include "modules/reconstructor/rectifier.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "tests/reconstructor/stereo_truth.hpp"
#include "tests/reconstructor/synthetic_pair.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::reconstructor {
namespace {

TEST(Rectifier, HandsARectifiedPairThrough) {
  const Rectifier rectifier(test::ideal_calibration());
  const auto pair = test::pair_of([](int, int) { return 10.0; });

  const RectifiedPair rectified = rectifier.rectify(pair.left, pair.right);

  EXPECT_EQ(rectified.left.data, pair.left.data);
  EXPECT_EQ(rectified.right.data, pair.right.data);
  EXPECT_NEAR(rectifier.baseline_m(), 0.12, 1e-12);
  EXPECT_NEAR(rectifier.camera().fx, 500.0, 1e-9);
}

TEST(Rectifier, SaysThatLeftAndRightAreSwapped) {
  StereoCalibration calibration = test::ideal_calibration();
  calibration.T = {0.12, 0.0, 0.0};
  try {
    const Rectifier rectifier(calibration);
    FAIL() << "must throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("left and right are swapped"));
    EXPECT_THAT(error.what(), testing::HasSubstr("-0.12"));
  }
}

TEST(Rectifier, RefusesCamerasAboveOneAnother) {
  StereoCalibration calibration = test::ideal_calibration();
  calibration.T = {0.0, -0.12, 0.0};
  EXPECT_THROW(Rectifier{calibration}, std::invalid_argument);
}

TEST(Rectifier, RefusesAPairOfWhichRectifiedImagesShowNothing) {
  StereoCalibration calibration = test::ideal_calibration();
  calibration.left.camera.cx = calibration.right.camera.cx = 0.0;  // cv::stereoRectify: NaN
  EXPECT_THAT(test::error_of<std::invalid_argument>([&] { Rectifier{calibration}; }),
              testing::HasSubstr("rectified images would show nothing that both cameras see"));
}

TEST(Rectifier, RefusesImagesOfAnotherSize) {
  const Rectifier rectifier(test::ideal_calibration());
  EXPECT_THROW(rectifier.rectify(cv::Mat1b(240, 320), cv::Mat1b(240, 320)), std::invalid_argument);
}

TEST(Rectifier, ScalesTheCameraAroundPixelCentres) {
  const Rectifier rectifier(test::ideal_calibration(), 0.5);
  // Column c of the small image covers columns 2c and 2c + 1, whose middle is 2c + 0.5.
  EXPECT_EQ(rectifier.camera().width, 320);
  EXPECT_DOUBLE_EQ(rectifier.camera().cx, (319.5 - 0.5) / 2.0);
  EXPECT_DOUBLE_EQ(rectifier.camera().fx, 250.0);
}

TEST(Rectifier, UnifiesDifferentPrincipalPoints) {
  StereoCalibration calibration = test::ideal_calibration();
  calibration.right.camera.cx = 309.5;
  Rectification rectification;
  rectification.R1 = rectification.R2 = Eigen::Matrix3d::Identity();
  rectification.P1 << 500, 0, 319.5, 0, 0, 500, 239.5, 0, 0, 0, 1, 0;
  rectification.P2 << 500, 0, 309.5, -60, 0, 500, 239.5, 0, 0, 0, 1, 0;
  calibration.rectification = rectification;
  const Rectifier rectifier(calibration);
  cv::Mat1b left(480, 640, uchar{0}), right(480, 640, uchar{0});
  right(100, 200) = 255;

  const RectifiedPair rectified = rectifier.rectify(left, right);

  EXPECT_EQ(rectified.right.at<uchar>(100, 210), 255);  // 200 + 319.5 - 309.5
}

TEST(Rectifier, FindsTheRectificationThatTheCalibrationFileHas) {
  const std::string folder = test::stereo_dev_folder() + "/distorted";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  StereoCalibration calibration = test::read_calibration(folder);
  const Rectifier given(calibration);
  calibration.rectification.reset();
  const Rectifier computed(calibration);

  EXPECT_NEAR(computed.baseline_m(), given.baseline_m(), 1e-6);
  EXPECT_NEAR(computed.camera().fx, given.camera().fx, 0.5);
}

}  // namespace
}  // namespace limbcast::reconstructor
