#include "common/camera/lens_projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace limbcast {
namespace {

const LensCalibration kFisheye{
    {640, 480, 224.0, 226.0, 321.0, 238.0}, {-0.01, 0.03, -0.02, 0.004}, LensModel::kFisheye};

/// Kannala and Brandt's polynomial for a ray at `angle` to the axis [focal lengths].
double place_of(double angle) {
  return angle - 0.01 * std::pow(angle, 3) + 0.03 * std::pow(angle, 5) - 0.02 * std::pow(angle, 7) +
         0.004 * std::pow(angle, 9);
}

TEST(LensProjection, PutsTheRaysOfAFisheyeByTheirAngle) {
  for (const double angle : {0.1, 0.7, 1.3}) {
    const std::vector<cv::Point3d> points{{2.0 * std::tan(angle), 0.0, 2.0},
                                          {0.0, -3.0 * std::tan(angle), 3.0}};
    std::vector<cv::Point2d> pixels;
    project_points(points, cv::Vec3d::all(0.0), cv::Vec3d::all(0.0), kFisheye, pixels);
    EXPECT_NEAR(pixels[0].x, 321.0 + 224.0 * place_of(angle), 1e-9);
    EXPECT_NEAR(pixels[0].y, 238.0, 1e-9);
    EXPECT_NEAR(pixels[1].y, 238.0 - 226.0 * place_of(angle), 1e-9);

    std::vector<cv::Point2d> tangents;
    undistort_points(pixels, tangents, kFisheye);
    EXPECT_NEAR(tangents[0].x, std::tan(angle), 1e-6);
    EXPECT_NEAR(tangents[1].y, -std::tan(angle), 1e-6);
  }
}

TEST(LensProjection, MapsEachPixelOfAnIdealCameraToTheFisheyesPixelOfItsRay) {
  const cv::Matx33d K(224.0, 0.0, 320.0, 0.0, 224.0, 240.0, 0.0, 0.0, 1.0);
  const LensMaps maps = undistorting_maps(kFisheye, cv::noArray(), K, {640, 480});
  const auto pixel = maps.xy.at<cv::Vec2s>(240, 520);
  // Maps hold whole pixels and, beside them, fractions.
  EXPECT_EQ(pixel[0], std::floor(321.0 + 224.0 * place_of(std::atan(200.0 / 224.0))));
  EXPECT_EQ(pixel[1], 238);
}

TEST(LensProjection, KnowsThatAFisheyeWithoutCoefficientsIsNoIdealCamera) {
  LensCalibration lens = kFisheye;
  lens.distortion.assign(4, 0.0);
  EXPECT_TRUE(has_distortion(lens));
  lens.model = LensModel::kPinhole;
  EXPECT_FALSE(has_distortion(lens));
  lens.distortion[1] = 0.1;
  EXPECT_TRUE(has_distortion(lens));
}

}  // namespace
}  // namespace limbcast
