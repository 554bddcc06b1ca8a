#include "modules/depth_camera/registration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

namespace limbcast::depth_camera {
namespace {

/// A depth camera 5 cm to the left of a colour camera with the same lens, in millimetres.
DepthCalibration side_by_side() {
  DepthCalibration calibration;
  calibration.color.camera = {64, 48, 100.0, 100.0, 32.0, 24.0};
  calibration.depth_camera.emplace();
  calibration.depth_camera->lens = calibration.color;
  calibration.depth_camera->T = {-0.05, 0.0, 0.0};
  return calibration;
}

cv::Mat1w empty_depth() { return cv::Mat1w(48, 64, std::uint16_t{0}); }

TEST(DepthRegistration, MovesAPixelByTheParallax) {
  cv::Mat1w depth = empty_depth();
  depth(20, 40) = 1000;
  const cv::Mat1w result = DepthRegistration(side_by_side()).registered(depth);
  EXPECT_EQ(result(20, 35), 1000);  // 100 px * 0.05 m / 1 m = 5 px to the left
  EXPECT_EQ(cv::countNonZero(result), 1);
}

TEST(DepthRegistration, KeepsTheNearestWherePixelsMeet) {
  cv::Mat1w depth = empty_depth();
  depth(20, 40) = 1000;  // to column 35
  depth(20, 45) = 500;   // by 10 px, to column 35 too
  EXPECT_EQ(DepthRegistration(side_by_side()).registered(depth)(20, 35), 500);
  depth(20, 45) = 0;
  depth(20, 37) = 2500;  // by 2 px
  EXPECT_EQ(DepthRegistration(side_by_side()).registered(depth)(20, 35), 1000);
}

TEST(DepthRegistration, LeavesNoGapsInALargerColorImage) {
  DepthCalibration calibration = side_by_side();
  calibration.color.camera = {160, 120, 250.0, 250.0, 79.5, 59.5};
  calibration.depth_camera->T.setZero();
  const cv::Mat1w wall(48, 64, std::uint16_t{2000});
  const cv::Mat1w result = DepthRegistration(calibration).registered(wall);
  // The wall fills the depth image; all of the colour image that lies within its view.
  const cv::Mat inner = result(cv::Rect(4, 4, 150, 110));
  EXPECT_EQ(cv::countNonZero(inner), static_cast<int>(inner.total()));
  EXPECT_EQ(cv::countNonZero(result != 2000), cv::countNonZero(result == 0));
}

TEST(DepthRegistration, TellsDepthAlongTheColorCamerasAxis) {
  DepthCalibration calibration = side_by_side();
  constexpr double kAngle = 0.2;
  calibration.depth_camera->R =
      Eigen::AngleAxisd(kAngle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  calibration.depth_camera->T.setZero();
  cv::Mat1w depth = empty_depth();
  depth(24, 32) = 1000;  // on the depth camera's axis
  const cv::Mat1w result = DepthRegistration(calibration).registered(depth);
  const int column = static_cast<int>(std::lround(32.0 + 100.0 * std::tan(kAngle)));
  EXPECT_EQ(result(24, column), std::lround(1000.0 * std::cos(kAngle)));
}

TEST(DepthRegistration, LeavesOutWhatTheColorCameraDoesNotSee) {
  DepthCalibration calibration = side_by_side();
  calibration.depth_camera->T = {0.0, 0.0, -1.5};  // the colour camera stands 1.5 m ahead
  const cv::Mat1w wall(48, 64, std::uint16_t{1000});
  EXPECT_EQ(cv::countNonZero(DepthRegistration(calibration).registered(wall)), 0);
  EXPECT_EQ(cv::countNonZero(DepthRegistration(calibration).registered(empty_depth())), 0);
}

TEST(DepthRegistration, HeedsBothLensesDistortion) {
  DepthCalibration calibration = side_by_side();
  calibration.depth_camera->T.setZero();
  calibration.color.distortion =
      calibration.depth_camera->lens.distortion = {-0.3, 0.1, 0.001, -0.001, 0.0};
  cv::Mat1w depth = empty_depth();
  depth(5, 7) = 1500;
  const cv::Mat1w result = DepthRegistration(calibration).registered(depth);
  EXPECT_EQ(result(5, 7), 1500);
}

TEST(DepthRegistration, PutsWhatAFisheyeSeesWhereItIs) {
  DepthCalibration calibration = side_by_side();
  calibration.depth_camera->T.setZero();
  LensCalibration& lens = calibration.depth_camera->lens;
  lens.model = LensModel::kFisheye;
  lens.distortion.assign(4, 0.0);
  lens.camera.fx = lens.camera.fy = 30.0;
  calibration.color.camera.fx = calibration.color.camera.fy = 20.0;
  cv::Mat1w depth = empty_depth();
  depth(24, 52) = 1000;  // 20 px / 30 px = 0.667 rad to the right of the axis
  const cv::Mat1w result = DepthRegistration(calibration).registered(depth);
  const int column = static_cast<int>(std::lround(32.0 + 20.0 * std::tan(20.0 / 30.0)));
  EXPECT_EQ(result(24, column), 1000);
}

}  // namespace
}  // namespace limbcast::depth_camera
