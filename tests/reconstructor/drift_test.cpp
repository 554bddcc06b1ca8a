#include "modules/reconstructor/drift.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "modules/reconstructor/reconstructor.hpp"
#include "modules/reconstructor/row_differences.hpp"
#include "tests/reconstructor/stereo_truth.hpp"
#include "tests/reconstructor/synthetic_pair.hpp"

namespace limbcast::reconstructor {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kSecond_us = 1'000'000;

/// A wall at a disparity of 20 px, the right image shifted down and rolled about its middle.
RectifiedPair turned_pair(double down_px, double roll_rad) {
  const cv::Mat left = test::scene_texture();
  const double cos = std::cos(roll_rad);
  const double sin = std::sin(roll_rad);
  constexpr double kMiddleU = 320.0, kMiddleV = 240.0, kDisparity_px = 20.0;
  const cv::Matx23d turn(cos, -sin, kMiddleU * (1.0 - cos) + kMiddleV * sin - kDisparity_px,  //
                         sin, cos, kMiddleV * (1.0 - cos) - kMiddleU * sin + down_px);
  cv::Mat right;
  cv::warpAffine(left, right, turn, left.size());
  return {left, right};
}

TEST(RowDifferences, TellHowFarTheRightImageStandsLower) {
  std::vector<double> differences_px = row_differences_px(turned_pair(1.5, 0.0));
  ASSERT_GT(differences_px.size(), 100U);
  for (const double difference_px : differences_px) EXPECT_NEAR(difference_px, 1.5, 0.5);
  EXPECT_NEAR(median_size_px(differences_px), 1.5, 0.05);
}

TEST(RowDifferences, ShowACameraThatRolled) {
  // Left of the middle the rows go up, right of it down: 160 px * 0.01 = 1.6 px halfway to the
  // borders.
  const std::vector<double> differences_px = row_differences_px(turned_pair(0.0, 0.01));
  const auto [least, largest] = std::minmax_element(differences_px.begin(), differences_px.end());
  EXPECT_LT(*least, -1.0);
  EXPECT_GT(*largest, 1.0);
  EXPECT_GT(median_size_px(differences_px), 0.8);
}

TEST(RowDifferences, AreFoundWhereTheCamerasAreFarOff) {
  const std::vector<double> differences_px = row_differences_px(turned_pair(15.0, 0.0));
  ASSERT_GT(differences_px.size(), 100U);
  EXPECT_NEAR(median_size_px(differences_px), 15.0, 0.1);
}

TEST(RowDifferences, AreNoneWithoutTexture) {
  const cv::Mat1b wall(480, 640, uchar{128});
  EXPECT_TRUE(row_differences_px({wall, wall}).empty());
}

TEST(DriftMonitor, SaysNothingFromFewMeasurements) {
  DriftMonitor monitor;
  for (int i = 0; i < 4; ++i) monitor.add(i * kSecond_us, std::vector<double>(50, 2.0));
  EXPECT_FALSE(monitor.row_difference_px());
  monitor.add(4 * kSecond_us, std::vector<double>(50, 2.0));
  EXPECT_EQ(monitor.drift_px(), 2.0);
}

TEST(DriftMonitor, LeavesOutPairsWithFewCorners) {
  DriftMonitor monitor;
  for (int i = 0; i < 20; ++i) monitor.add(i * kSecond_us, std::vector<double>(10, 2.0));
  EXPECT_FALSE(monitor.row_difference_px());
}

TEST(DriftMonitor, IsNotMovedByAFewPairsThatDoNotFit) {
  DriftMonitor monitor;
  for (int i = 0; i < 30; ++i)
    monitor.add(i * kSecond_us, std::vector<double>(50, i % 4 == 0 ? -7.0 : -0.1));
  EXPECT_EQ(monitor.row_difference_px(), 0.1);
  EXPECT_FALSE(monitor.drift_px());
}

TEST(DriftMonitor, ForgetsADriftThatIsOver) {
  DriftMonitor monitor;
  for (int i = 0; i < 9; ++i) monitor.add(i * kSecond_us, std::vector<double>(50, 2.0));
  ASSERT_TRUE(monitor.drift_px());
  for (int i = 9; i < 14; ++i) monitor.add(i * kSecond_us, std::vector<double>(50, 0.1));
  EXPECT_FALSE(monitor.drift_px());
}

TEST(DriftMonitor, MeasuresOnceASecondAlsoWhereTimesJumpBack) {
  DriftMonitor monitor;
  EXPECT_TRUE(monitor.is_due(100 * kSecond_us));
  monitor.add(100 * kSecond_us, {});
  EXPECT_FALSE(monitor.is_due(100 * kSecond_us + 999'999));
  EXPECT_TRUE(monitor.is_due(101 * kSecond_us));
  EXPECT_TRUE(monitor.is_due(0));
}

TEST(DriftMonitor, TellsAGroundThatLeansMoreThanToldGravityMayBeOff) {
  DriftMonitor monitor;
  auto add = [&monitor, utime = std::int64_t{0}](double lean_deg) mutable {
    monitor.add(utime += kSecond_us, {}, GroundLean{2.0 * lean_deg, lean_deg});
  };
  for (int i = 0; i < 9; ++i) add(i % 4 == 0 ? 5.0 : 1.0);
  EXPECT_FALSE(monitor.lean());
  for (int i = 0; i < 9; ++i) add(-2.0);
  ASSERT_TRUE(monitor.lean());
  EXPECT_EQ(monitor.lean()->lean_deg, -2.0);
  EXPECT_EQ(monitor.lean()->offset_px, -4.0);
  for (int i = 0; i < 9; ++i) add(0.5);
  EXPECT_FALSE(monitor.lean());
}

/// Drift that the pairs of a recording show; nothing where they show none.
std::optional<double> drift_of(const std::vector<std::string>& lefts,
                               const StereoCalibration& calibration) {
  const Rectifier rectifier(calibration);
  DriftMonitor monitor;
  std::int64_t utime = 0;
  for (const std::string& left : lefts) {
    std::string right = left;
    right.replace(right.rfind("left"), 4, "right");
    const RectifiedPair pair = rectifier.rectify(cv::imread(left, cv::IMREAD_GRAYSCALE),
                                                 cv::imread(right, cv::IMREAD_GRAYSCALE));
    monitor.add(utime += kSecond_us, row_differences_px(pair));
  }
  EXPECT_TRUE(monitor.row_difference_px());
  return monitor.drift_px();
}

std::vector<std::string> left_images(const std::string& folder, std::size_t every) {
  std::vector<std::string> paths;
  for (const fs::directory_entry& file : fs::directory_iterator(folder)) {
    if (file.path().extension() == ".jpg" &&
        file.path().filename().string().find("left") != std::string::npos)
      paths.push_back(file.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> chosen;
  for (std::size_t i = 0; i < paths.size(); i += every) chosen.push_back(paths[i]);
  return chosen;
}

/// The calibration beside OpenCV's example pairs: its names are its own, its lengths in squares.
StereoCalibration example_calibration(const std::string& folder) {
  const cv::FileStorage file(folder + "/stereo_calibration.yml", cv::FileStorage::READ);
  StereoCalibration calibration;
  for (const auto& [lens, side] :
       {std::pair(&calibration.left, "left"), std::pair(&calibration.right, "right")}) {
    cv::Mat1d K;
    cv::Mat1d distortion;
    file[std::string("camera_matrix_") + side] >> K;
    file[std::string("distortion_") + side] >> distortion;
    lens->camera = {640, 480, K(0, 0), K(1, 1), K(0, 2), K(1, 2)};
    lens->distortion.assign(distortion.begin(), distortion.end());
  }
  cv::Mat R;
  cv::Mat T;
  file["R"] >> R;
  file["T_in_board_squares"] >> T;
  cv::cv2eigen(R, calibration.R);
  cv::cv2eigen(T, calibration.T);
  return calibration;
}

TEST(Drift, IsSeenOnRealPairsWithATurnedCalibrationOnly) {
  const std::string folder = std::string(LIMBCAST_DATA_DIR) + "/stereo_opencv";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const StereoCalibration calibration = example_calibration(folder);
  const std::vector<std::string> lefts = left_images(folder, 1);
  EXPECT_FALSE(drift_of(lefts, calibration));
  // 535 px * 0.0035 = 1.9 px; rolling, half of it or less.
  EXPECT_NEAR(drift_of(lefts, test::turned(calibration, 0.0035, 0.0)).value_or(0.0), 1.9, 0.3);
  EXPECT_TRUE(drift_of(lefts, test::turned(calibration, 0.0, 0.01)));
}

TEST(Drift, IsSeenOnNoRecordingUnlessTheCalibrationIsTurned) {
  const std::string data = test::stereo_dev_folder();
  if (!fs::exists(data)) GTEST_SKIP() << data << " is absent";
  for (const char* name :
       {"pointing", "general", "multi", "nohuman", "sequence", "distorted", "hd"}) {
    const std::string folder = data + "/" + name;
    const StereoCalibration calibration = test::read_calibration(folder);
    const std::vector<std::string> lefts = left_images(folder, 2);
    EXPECT_FALSE(drift_of(lefts, calibration)) << name;
    EXPECT_TRUE(drift_of(lefts, test::turned(calibration, 0.0035, 0.0))) << name;
    EXPECT_TRUE(drift_of(lefts, test::turned(calibration, 0.0, 0.01))) << name;
  }
}

/// How the ground of a recording lies against gravity, with the right camera turned about its
/// upright axis; nothing where it lies as gravity tells.
std::optional<GroundLean> lean_of(const std::string& folder, double turn_rad) {
  StereoCalibration calibration = test::read_calibration(folder);
  if (turn_rad != 0.0) {
    calibration.R = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitY()) * calibration.R;
    calibration.rectification.reset();
  }
  const StereoReconstructor reconstructor(calibration, ReconstructorOptions{});
  DriftMonitor monitor;
  std::int64_t utime = 0;
  for (const std::string& name : test::frame_names(folder)) {
    const test::TrueFrame frame =
        test::read_true_frame(folder, name, reconstructor.focal_baseline_px_m());
    StereoImages images;
    images.left = frame.left;
    images.right = frame.right;
    images.stamp.gravity.down = frame.down;
    images.stamp.gravity.source = GravitySource::kRecording;
    monitor.add(
        utime += kSecond_us, {},
        ground_lean(reconstructor.reconstruct(images), reconstructor.focal_baseline_px_m()));
    if (utime >= 12 * kSecond_us) break;
  }
  return monitor.lean();
}

TEST(Drift, IsSeenOnTheGroundOfARecordingWhoseRightCameraTurned) {
  const std::string data = test::stereo_dev_folder();
  if (!fs::exists(data)) GTEST_SKIP() << data << " is absent";
  for (const char* name : {"general", "multi", "hd"}) {
    const std::string folder = data + "/" + name;
    EXPECT_FALSE(lean_of(folder, 0.0)) << name;
    const double focal_px = test::read_calibration(folder).left.camera.fx;
    for (const double turn_rad : {0.006, -0.006}) {
      const auto ground = lean_of(folder, turn_rad);
      ASSERT_TRUE(ground) << name;
      EXPECT_NEAR(ground->offset_px, focal_px * turn_rad, 0.6) << name;
    }
  }
}

}  // namespace
}  // namespace limbcast::reconstructor
