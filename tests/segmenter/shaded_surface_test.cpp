#include "modules/segmenter/shaded_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace limbcast::segmenter {
namespace {

constexpr int kWidth_px = 100, kHeight_px = 80;

PinholeCamera small_camera() {
  PinholeCamera camera;
  camera.width = kWidth_px;
  camera.height = kHeight_px;
  camera.fx = camera.fy = 100.0;
  camera.cx = 50.0;
  camera.cy = 40.0;
  return camera;
}

/// Points of a plate across the view, from pixel (30, 20) to (70, 60), as a scanner sees it whose
/// rows stand `row_px` apart.
std::vector<Eigen::Vector3f> plate(float depth_m, int row_px) {
  const PinholeCamera camera = small_camera();
  std::vector<Eigen::Vector3f> points_m;
  for (int v = 20; v <= 60; v += row_px) {
    for (int u = 30; u <= 70; ++u)
      points_m.push_back(
          camera.back_project(static_cast<float>(u), static_cast<float>(v), depth_m));
  }
  return points_m;
}

class ShadedSurface : public ::testing::Test {
 protected:
  cv::Mat3b draw(const std::vector<Eigen::Vector3f>& points_m) const {
    return draw_shaded(points_m, small_camera(), params_);
  }
  bool is_wall(const cv::Mat3b& picture, int u, int v) const {
    return picture(v, u) == cv::Vec3b(params_.wall.data());
  }
  /// Share of the pixels from (30, 20) to (70, 60) that show something.
  static double share_shown(const cv::Mat3b& picture, const ShadedSurfaceParams& params) {
    const cv::Rect place(30, 20, 41, 41);
    cv::Mat1b shown;
    cv::inRange(picture(place), cv::Scalar(cv::Vec3b(params.wall.data())),
                cv::Scalar(cv::Vec3b(params.wall.data())), shown);
    return 1.0 - static_cast<double>(cv::countNonZero(shown)) / place.area();
  }

  ShadedSurfaceParams params_;
};

TEST_F(ShadedSurface, IsAWallWhereNothingIs) {
  const cv::Mat3b picture = draw({});
  EXPECT_EQ(picture.size(), cv::Size(kWidth_px, kHeight_px));
  EXPECT_TRUE(is_wall(picture, 50, 40));
}

TEST_F(ShadedSurface, IsClosedBetweenTheRowsOfAScanner) {
  for (const int row_px : {1, 2, 4, 8})
    EXPECT_EQ(share_shown(draw(plate(2.0F, row_px)), params_), 1.0) << row_px;
}

TEST_F(ShadedSurface, HasAHoleWhereManyRowsAreMissing) {
  std::vector<Eigen::Vector3f> points_m;
  for (const Eigen::Vector3f& point_m : plate(2.0F, 2)) {
    const float v = small_camera().project(point_m).y();
    if (v < 35.0F || v > 47.0F) points_m.push_back(point_m);
  }
  const cv::Mat3b picture = draw(points_m);
  EXPECT_TRUE(is_wall(picture, 50, 41));
  EXPECT_FALSE(is_wall(picture, 50, 30));
}

TEST_F(ShadedSurface, IsOpenBetweenALimbAndWhatStandsBehindIt) {
  for (const float step_m : {0.5F, 2.0F}) {
    std::vector<Eigen::Vector3f> points_m = plate(2.0F, 4);
    // The lower half stands farther away.
    for (Eigen::Vector3f& point_m : points_m) {
      if (point_m.y() > 0.01F) point_m *= (2.0F + step_m * params_.max_jump_m) / 2.0F;
    }
    EXPECT_EQ(is_wall(draw(points_m), 50, 42), step_m > 1.0F) << step_m;
  }
}

TEST_F(ShadedSurface, IsLightOnItsUpperSide) {
  // An arm that lies across the view, 16 pixels thick.
  constexpr float kRadius_m = 0.16F, kDistance_m = 2.0F;
  std::vector<Eigen::Vector3f> points_m;
  for (float turn_rad = -1.5F; turn_rad <= 1.5F; turn_rad += 0.05F) {
    for (float right_m = -0.4F; right_m <= 0.4F; right_m += 0.01F)
      points_m.emplace_back(right_m, kRadius_m * std::sin(turn_rad),
                            kDistance_m - kRadius_m * std::cos(turn_rad));
  }
  const cv::Mat3b picture = draw(points_m);
  const int above = picture(40 - 5, 50)[1], middle = picture(40, 50)[1],
            below = picture(40 + 5, 50)[1];
  EXPECT_GT(above, middle);
  EXPECT_GT(middle, below + 20);
}

TEST_F(ShadedSurface, ShowsTheNearestPointsOfAPixel) {
  std::vector<Eigen::Vector3f> points_m = plate(2.0F, 1);
  const cv::Mat3b alone = draw(points_m);
  // A rough wall behind it.
  for (const Eigen::Vector3f& point_m : plate(2.0F, 1))
    points_m.push_back((1.5F + 0.2F * std::sin(40.0F * point_m.x())) * point_m);
  EXPECT_EQ(cv::norm(draw(points_m), alone, cv::NORM_INF), 0.0);
}

TEST_F(ShadedSurface, LeavesOutPointsThatTheCameraDoesNotSee) {
  std::vector<Eigen::Vector3f> points_m = plate(2.0F, 1);
  const cv::Mat3b alone = draw(points_m);
  // Behind the camera, on the same lines.
  for (const Eigen::Vector3f& point_m : plate(2.0F, 1)) points_m.push_back(-point_m);
  points_m.emplace_back(9.0F, 0.0F, 1.0F);
  points_m.emplace_back(0.0F, -9.0F, 1.0F);
  EXPECT_EQ(cv::norm(draw(points_m), alone, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace limbcast::segmenter
