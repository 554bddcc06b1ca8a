#include "modules/reconstructor/depth_to_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace limbcast::reconstructor {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr double kFocalPx = 300.0;

/// Cloud of a camera that measures depth_at(u, v) metres at each pixel, to the millimetre.
Cloud cloud_of(const std::function<double(int, int)>& depth_at) {
  DepthCalibration calibration;
  calibration.color.camera = {kWidth, kHeight, kFocalPx, kFocalPx, kWidth / 2.0, kHeight / 2.0};
  cv::Mat1w depth_mm(kHeight, kWidth);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u)
      depth_mm(v, u) = static_cast<std::uint16_t>(std::lround(1000.0 * depth_at(u, v)));
  }
  return DepthToCloud(calibration).cloud_of(depth_mm, {});
}

int holes(const Cloud& cloud) {
  int count = 0;
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) count += cloud.is_hole(i) ? 1 : 0;
  return count;
}

TEST(DepthToCloud, RemovesTheSkirtThatASmoothingSensorDrawsFromABodyToTheWall) {
  constexpr int kSkirtBegin = 60, kSkirtEnd = 70;
  const auto depth_at = [](int u, int /*v*/) {
    if (u < kSkirtBegin) return 2.0;
    if (u > kSkirtEnd) return 2.6;
    return 2.0 + 0.6 * (u - kSkirtBegin) / (kSkirtEnd - kSkirtBegin);
  };
  const Cloud cloud = cloud_of(depth_at);
  const auto is_hole = [&cloud](int u) {
    return cloud.is_hole(static_cast<std::size_t>(kHeight / 2) * kWidth +
                         static_cast<std::size_t>(u));
  };
  EXPECT_FALSE(is_hole(kSkirtBegin)) << "the body's edge";
  EXPECT_TRUE(is_hole((kSkirtBegin + kSkirtEnd) / 2));
  EXPECT_FALSE(is_hole(kSkirtEnd + 1)) << "the wall";
}

TEST(DepthToCloud, KeepsWallsAndFloorsThatAreSeenAtAFlatAngle) {
  const auto wall = [](int u, int /*v*/) {
    constexpr double kSlope = 3.0;  // 72 degrees off the line of sight
    return 2.0 / (1.0 - kSlope * (u - kWidth / 2.0) / kFocalPx * 0.5);
  };
  EXPECT_EQ(holes(cloud_of(wall)), 0);
  const auto floor = [](int /*u*/, int v) {
    constexpr double kSensorHeight = 1.2;
    return v > kHeight / 2 + 60 - 1 ? 3.0 : kSensorHeight * kFocalPx / (v + 60.0);
  };
  EXPECT_EQ(holes(cloud_of(floor)), 0);
}

TEST(DepthToCloud, KeepsHolesAndWhatStandsBesideThem) {
  const Cloud cloud = cloud_of([](int u, int /*v*/) { return u < 80 ? 2.0 : 0.0; });
  EXPECT_EQ(holes(cloud), kHeight * 80);
}

TEST(DepthToCloud, TakesTheNearestPixelOfADistortedImage) {
  const double k1 = -0.2;
  DepthCalibration calibration;
  calibration.color = {{kWidth, kHeight, kFocalPx, kFocalPx, kWidth / 2.0, kHeight / 2.0},
                       {k1, 0.0, 0.0, 0.0}};
  // Each depth tells its column.
  cv::Mat1w depth_mm(kHeight, kWidth);
  for (int u = 0; u < kWidth; ++u) depth_mm.col(u) = 1000 + u;
  const Cloud cloud = DepthToCloud(calibration).cloud_of(depth_mm, {});
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double x = (u - kWidth / 2.0) / kFocalPx;
      const double y = (v - kHeight / 2.0) / kFocalPx;
      const double seen_at = kWidth / 2.0 + kFocalPx * x * (1.0 + k1 * (x * x + y * y));
      const std::size_t i = static_cast<std::size_t>(v) * kWidth + static_cast<std::size_t>(u);
      // OpenCV's maps tell 1/32 px.
      EXPECT_NEAR(1000.0 * cloud.points_m[i].z() - 1000.0, seen_at, 0.5 + 1.0 / 32.0);
    }
  }
}

TEST(DepthToCloud, PutsWhatAFisheyeSeesWhereItIs) {
  DepthCalibration calibration;
  calibration.color = {
      {kWidth, kHeight, 60.0, 60.0, 80.0, 60.0}, {0.0, 0.0, 0.0, 0.0}, LensModel::kFisheye};
  // A post, seen 0.75 rad to the right of the middle.
  cv::Mat1w depth_mm(kHeight, kWidth, std::uint16_t{0});
  depth_mm.colRange(123, 128) = 1000;
  const Cloud cloud = DepthToCloud(calibration).cloud_of(depth_mm, {});
  double sum_x_m = 0.0;
  int count = 0;
  for (int u = 0; u < kWidth; ++u) {
    const std::size_t i = 60UL * kWidth + static_cast<std::size_t>(u);
    if (cloud.is_hole(i)) continue;
    sum_x_m += cloud.points_m[i].x();
    ++count;
  }
  ASSERT_GT(count, 0);
  EXPECT_NEAR(sum_x_m / count, std::tan(0.75), 0.5 / 60.0);  // half a pixel
}

}  // namespace
}  // namespace limbcast::reconstructor
