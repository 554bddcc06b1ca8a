#include "modules/reconstructor/rectification.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "common/camera/opencv_conversion.hpp"
#include "common/median.hpp"
#include "common/units.hpp"
#include "modules/reconstructor/reconstructor.hpp"
#include "tests/reconstructor/synthetic_pair.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::reconstructor {
namespace {

/// Two fisheye lenses, 164 degrees across, turned by some degrees and 12 cm apart.
StereoCalibration fisheye_pair() {
  StereoCalibration calibration;
  calibration.left = {
      {640, 480, 224.0, 225.0, 322.0, 236.0}, {-0.01, 0.03, -0.02, 0.004}, LensModel::kFisheye};
  calibration.right = {
      {640, 480, 226.0, 225.0, 315.0, 244.0}, {0.005, 0.02, -0.015, 0.003}, LensModel::kFisheye};
  calibration.R = (Eigen::AngleAxisd(-0.03, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX()) *
                   Eigen::AngleAxisd(-0.015, Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  calibration.T = {-0.12, 0.002, -0.004};
  return calibration;
}

double half_angle_deg(double length_px, double focal_px) {
  return kDegreesPerRadian<double> * std::atan(length_px / focal_px);
}

constexpr double kWall_m = 2.5;

/// What the texture of a wall, whose middle is at `wall_m` in the left camera's frame, shows on a
/// ray: so large that a fisheye, whose pixels are coarser far off its axis, still sees it.
uchar grey_of(const test::Texture& texture, const Eigen::Vector3d& wall_m) {
  constexpr double kPixelsPerMeter = 40.0;
  return cv::saturate_cast<uchar>(
      texture(kPixelsPerMeter * wall_m.x(), kPixelsPerMeter * wall_m.y()));
}

/// What a fisheye camera sees of the wall z = kWall_m of the left camera; p_camera = R p_left + T.
cv::Mat picture_of_wall(const LensCalibration& lens, const Eigen::Matrix3d& R,
                        const Eigen::Vector3d& T) {
  const test::Texture texture;
  const Eigen::Vector3d center = -R.transpose() * T;
  std::vector<cv::Point2d> pixels;
  for (int v = 0; v < lens.camera.height; ++v)
    for (int u = 0; u < lens.camera.width; ++u) pixels.emplace_back(u, v);
  std::vector<cv::Point2d> tangents;
  cv::fisheye::undistortPoints(pixels, tangents, camera_matrix(lens.camera), lens.distortion);
  cv::Mat1b picture(lens.camera.height, lens.camera.width, uchar{0});
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Eigen::Vector3d ray = R.transpose() * Eigen::Vector3d(tangents[i].x, tangents[i].y, 1.0);
    if (ray.z() <= 0.0) continue;
    const Eigen::Vector3d wall_m = center + (kWall_m - center.z()) / ray.z() * ray;
    picture(static_cast<int>(pixels[i].y), static_cast<int>(pixels[i].x)) =
        grey_of(texture, wall_m);
  }
  return picture;
}

StereoImages pictures_of_wall(const StereoCalibration& cameras) {
  StereoImages images;
  images.left = picture_of_wall(cameras.left, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  images.right = picture_of_wall(cameras.right, cameras.R, cameras.T);
  return images;
}

TEST(FisheyeRectification, SeesAsMuchAsAFlatImageShouldAndNoBlackBorder) {
  const StereoCalibration cameras = fisheye_pair();
  const Rectification rectification = compute_rectification(cameras);
  const auto& P = rectification.P1;
  EXPECT_NEAR(half_angle_deg(P(0, 2), P(0, 0)), 55.0, 0.1);
  EXPECT_NEAR(half_angle_deg(639.0 - P(0, 2), P(0, 0)), 55.0, 0.1);
  const Rectifier rectifier(cameras);
  const cv::Mat white(480, 640, CV_8UC1, cv::Scalar(255));
  const RectifiedPair pair = rectifier.rectify(white, white);
  EXPECT_EQ(cv::countNonZero(pair.left == 255), 640 * 480);
  EXPECT_EQ(cv::countNonZero(pair.right == 255), 640 * 480);
}

TEST(FisheyeRectification, SeesAllThatBothNarrowLensesShow) {
  StereoCalibration cameras = fisheye_pair();
  for (LensCalibration* lens : {&cameras.left, &cameras.right})
    lens->camera.fx = lens->camera.fy = 500.0;  // some 72 degrees across
  const Rectifier rectifier(cameras);
  // The nearest border is at the tangent of about 315 px / 500 px = 0.63 rad; the cameras' turns
  // cost some pixels.
  const double right_deg = half_angle_deg(639.0 - rectifier.camera().cx, rectifier.camera().fx);
  EXPECT_LT(right_deg, 36.1);
  EXPECT_GT(right_deg, 33.0);
  const cv::Mat white(480, 640, CV_8UC1, cv::Scalar(255));
  const RectifiedPair pair = rectifier.rectify(white, white);
  // The mean of a pixel within and one beyond the border is not white.
  EXPECT_GT(cv::countNonZero(pair.left > 200), 640 * 480 - 1200);
  EXPECT_GT(cv::countNonZero(pair.right > 200), 640 * 480 - 1200);
}

TEST(FisheyeRectification, SeesNoMoreWhereTheLensReachesBeyond90Degrees) {
  StereoCalibration cameras = fisheye_pair();
  for (LensCalibration* lens : {&cameras.left, &cameras.right})
    lens->camera.fx = lens->camera.fy = 120.0;  // beyond 200 degrees, in each direction
  const Rectification rectification = compute_rectification(cameras);
  EXPECT_NEAR(half_angle_deg(319.5, rectification.P1(0, 0)), 55.0, 1e-6);
  EXPECT_NEAR(rectification.P1(0, 2), 319.5, 1e-6);
  EXPECT_NEAR(rectification.P1(1, 2), 239.5, 1e-6);
}

/// Narrow lenses, some 14 degrees to each side, that converge by so much.
StereoCalibration converging_pair(double turn_deg) {
  StereoCalibration cameras = fisheye_pair();
  for (LensCalibration* lens : {&cameras.left, &cameras.right}) {
    lens->camera.fx = lens->camera.fy = 1300.0;
    lens->camera.cx = 319.5;
    lens->camera.cy = 239.5;
    lens->distortion = {0.0, 0.0, 0.0, 0.0};
  }
  cameras.R = Eigen::AngleAxisd(radians(turn_deg), Eigen::Vector3d::UnitY()).toRotationMatrix();
  cameras.T = {-0.12, 0.0, 0.0};
  return cameras;
}

TEST(FisheyeRectification, ShowsWhatBothSeeWhereTheyConverge) {
  // The rectified cameras look where the right one does, whose axis is at the left one's border.
  const Rectifier rectifier(converging_pair(16.0));
  const cv::Mat white(480, 640, CV_8UC1, cv::Scalar(255));
  const RectifiedPair pair = rectifier.rectify(white, white);
  EXPECT_GT(cv::countNonZero(pair.left > 200), 640 * 480 - 2000);
  EXPECT_GT(cv::countNonZero(pair.right > 200), 640 * 480 - 2000);
}

TEST(FisheyeRectification, RefusesCamerasThatSeeNothingInCommon) {
  for (const double turn_deg : {-40.0, 40.0}) {
    const StereoCalibration cameras = converging_pair(turn_deg);
    EXPECT_THAT(test::error_of<std::invalid_argument>([&] { Rectifier{cameras}; }),
                ::testing::HasSubstr("nothing that both cameras see"));
  }
}

TEST(FisheyeRectification, KeepsTheBaselineAndTheRows) {
  const StereoCalibration cameras = fisheye_pair();
  const Rectification rectification = compute_rectification(cameras);
  EXPECT_NEAR(Rectifier(cameras).baseline_m(), cameras.T.norm(), 1e-9);
  // A point in the left camera's frame, in both rectified images.
  const Eigen::Vector3d point(0.4, -0.3, 1.5);
  const Eigen::Vector3d left = rectification.P1 * (rectification.R1 * point).homogeneous();
  const Eigen::Vector3d right =
      rectification.P1.leftCols<3>() * rectification.R2 * (cameras.R * point + cameras.T);
  EXPECT_NEAR(left.y() / left.z(), right.y() / right.z(), 1e-9);
}

TEST(Rectifier, MakesOfAFisheyesPictureTheOneThatAnIdealCameraTakes) {
  const StereoCalibration cameras = fisheye_pair();
  const Rectifier rectifier(cameras);
  const StereoImages raw = pictures_of_wall(cameras);
  const cv::Mat rectified = rectifier.rectify(raw.left, raw.right).left;

  const test::Texture texture;
  const Eigen::Matrix3d left_from_rectified = compute_rectification(cameras).R1.transpose();
  std::vector<double> differences;
  for (int v = 0; v < rectified.rows; ++v) {
    for (int u = 0; u < rectified.cols; ++u) {
      const Eigen::Vector3d ray =
          left_from_rectified * rectifier.camera()
                                    .back_project(static_cast<float>(u), static_cast<float>(v), 1.0)
                                    .cast<double>();
      differences.push_back(
          std::abs(rectified.at<uchar>(v, u) - grey_of(texture, kWall_m / ray.z() * ray)));
    }
  }
  // What is lost by sampling twice; waves of 40 grey levels.
  EXPECT_LT(median(differences), 1.5);
  std::sort(differences.begin(), differences.end());
  EXPECT_LT(differences[differences.size() * 99 / 100], 10.0);
}

TEST(StereoReconstructor, FindsAWallAtItsDepthWithFisheyeLenses) {
  const StereoCalibration cameras = fisheye_pair();
  const StereoReconstructor reconstructor(cameras, {});
  const Cloud cloud = reconstructor.reconstruct(pictures_of_wall(cameras));

  const Eigen::Matrix3d left_from_rectified = compute_rectification(cameras).R1.transpose();
  std::vector<double> errors_m;
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    if (cloud.is_hole(i)) continue;
    const Eigen::Vector3d point = left_from_rectified * cloud.points_m[i].cast<double>();
    errors_m.push_back(std::abs(point.z() - kWall_m));
  }
  ASSERT_GT(errors_m.size(), 640U * 480U * 8U / 10U);
  // A tenth of a pixel: the disparity is 224 px * 0.12 m / 2.5 m = 10.8 px.
  EXPECT_LT(median(errors_m), 0.01 * kWall_m);
  std::sort(errors_m.begin(), errors_m.end());
  EXPECT_LT(errors_m[errors_m.size() * 95 / 100], 0.05 * kWall_m);
}

}  // namespace
}  // namespace limbcast::reconstructor
