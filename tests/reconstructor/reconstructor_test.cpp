#include "modules/reconstructor/reconstructor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/reconstructor/synthetic_pair.hpp"

namespace limbcast::reconstructor {
namespace {

StereoImages images_of(const RectifiedPair& pair) {
  StereoImages images;
  images.stamp.utime = 42;
  images.stamp.sensor = "front";
  images.left = pair.left;
  images.right = pair.right;
  return images;
}

double median_depth_m(const Cloud& cloud) {
  std::vector<float> depths_m;
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i)
    if (!cloud.is_hole(i)) depths_m.push_back(cloud.points_m[i].z());
  if (depths_m.empty()) return 0.0;
  std::nth_element(depths_m.begin(), depths_m.begin() + depths_m.size() / 2, depths_m.end());
  return depths_m[depths_m.size() / 2];
}

std::size_t count_points(const Cloud& cloud) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) count += !cloud.is_hole(i);
  return count;
}

TEST(StereoReconstructor, FindsAPlaneAtItsDepth) {
  const StereoReconstructor reconstructor(test::ideal_calibration(), {});
  const auto pair = test::pair_of([](int, int) { return 24.0; });

  const Cloud cloud = reconstructor.reconstruct(images_of(pair));

  ASSERT_TRUE(cloud.organized());
  EXPECT_NEAR(median_depth_m(cloud), 500.0 * 0.12 / 24.0, 0.01);
  EXPECT_GT(count_points(cloud), 640U * 480U * 95U / 100U);
  EXPECT_EQ(cloud.stamp.utime, 42);
  EXPECT_EQ(cloud.stamp.frame, "front/left_rectified");
  EXPECT_EQ(cloud.colors.size(), cloud.points_m.size());
}

TEST(StereoReconstructor, KeepsTheLeftColumns) {
  const StereoReconstructor reconstructor(test::ideal_calibration(), {});
  // Sixteen pixels of disparity: columns from 16 on are seen by both cameras.
  const auto pair = test::pair_of([](int, int) { return 16.0; });

  const DisparityImage disparity = reconstructor.match(pair);

  EXPECT_GT(cv::countNonZero(disparity.disparity_px.colRange(18, 60) > 0.0F), 42 * 480 * 95 / 100);
}

TEST(StereoReconstructor, PointsLieOnTheRaysOfTheirPixels) {
  const StereoReconstructor reconstructor(test::ideal_calibration(), {});
  const Cloud cloud =
      reconstructor.reconstruct(images_of(test::pair_of([](int, int) { return 20.0; })));
  const std::size_t index = 100UL * 640 + 400;
  ASSERT_FALSE(cloud.is_hole(index));
  const Eigen::Vector2f pixel = cloud.camera->project(cloud.points_m[index]);
  EXPECT_NEAR(pixel.x(), 400.0F, 1e-3F);
  EXPECT_NEAR(pixel.y(), 100.0F, 1e-3F);
}

TEST(StereoReconstructor, DropsWhatIsBeyondTheLimits) {
  ReconstructorOptions options;
  options.near_limit_m = 2.0;
  options.far_limit_m = 3.0;
  const StereoReconstructor reconstructor(test::ideal_calibration(), options);

  // 60 / 15 = 4 m, 60 / 24 = 2.5 m
  const auto far = test::pair_of([](int, int) { return 15.0; });
  const auto within = test::pair_of([](int, int) { return 24.0; });

  EXPECT_LT(count_points(reconstructor.reconstruct(images_of(far))), 640U * 480U / 100U);
  EXPECT_GT(count_points(reconstructor.reconstruct(images_of(within))), 640U * 480U * 9U / 10U);
  EXPECT_EQ(reconstructor.num_disparities(), 31);  // ceil(60 px m / 2 m) + 1
}

TEST(DepthReconstructor, DropsWhatIsNearerThanTheLimit) {
  DepthCalibration calibration;
  calibration.color.camera = {64, 48, 60.0, 60.0, 31.5, 23.5};
  DepthImages images;
  images.depth = cv::Mat(48, 64, CV_16U, cv::Scalar(500));
  ReconstructorOptions options;
  EXPECT_EQ(count_points(DepthReconstructor(calibration, options).reconstruct(images)), 64U * 48U);
  options.near_limit_m = 0.8;
  EXPECT_EQ(count_points(DepthReconstructor(calibration, options).reconstruct(images)), 0U);
}

TEST(ReconstructorOptions, RefuseLimitsTheWrongWayRound) {
  ReconstructorOptions options;
  EXPECT_NO_THROW(check(options));
  options.near_limit_m = 5.0;
  options.far_limit_m = 2.0;
  EXPECT_THROW(check(options), config::UsageError);
}

TEST(StereoReconstructor, RefusesARegionThatIsTooSmallToMatch) {
  ReconstructorOptions options;
  options.roi_width = 1;
  EXPECT_THROW(StereoReconstructor(test::ideal_calibration(), options), std::invalid_argument);
}

TEST(StereoReconstructor, FillsOnlyTheRegionOfInterest) {
  ReconstructorOptions options;
  options.roi_x = 200;
  options.roi_y = 100;
  options.roi_width = 150;
  options.roi_height = 80;
  const StereoReconstructor reconstructor(test::ideal_calibration(), options);

  const DisparityImage disparity =
      reconstructor.match(test::pair_of([](int, int) { return 20.0; }));

  const cv::Rect roi(200, 100, 150, 80);
  const int inside = cv::countNonZero(disparity.disparity_px(roi) > 0.0F);
  EXPECT_GT(inside, roi.area() * 95 / 100);
  EXPECT_EQ(cv::countNonZero(disparity.disparity_px > 0.0F), inside);
}

TEST(StereoReconstructor, WorksOnSmallerImages) {
  ReconstructorOptions options;
  options.image_scale = 0.5;
  const StereoReconstructor reconstructor(test::ideal_calibration(), options);
  const Cloud cloud =
      reconstructor.reconstruct(images_of(test::pair_of([](int, int) { return 30.0; })));
  EXPECT_EQ(cloud.width, 320);
  EXPECT_NEAR(median_depth_m(cloud), 2.0, 0.02);  // 250 px * 0.12 m / 15 px
}

TEST(DepthReconstructor, TurnsDepthIntoPointsAndDropsFlyingOnes) {
  DepthCalibration calibration;
  calibration.color.camera = {64, 48, 50.0, 50.0, 31.5, 23.5};
  DepthImages images;
  images.depth = cv::Mat1w(48, 64, ushort{1000});
  images.depth.colRange(32, 64) = 3000;
  images.depth.col(32) = 2000;  // neither the near nor the far surface
  images.depth.at<ushort>(5, 5) = 0;

  const Cloud cloud = DepthReconstructor(calibration, {}).reconstruct(images);

  EXPECT_TRUE(cloud.is_hole(5 * 64 + 5));
  EXPECT_TRUE(cloud.is_hole(10 * 64 + 32));
  EXPECT_FLOAT_EQ(cloud.points_m[10 * 64 + 31].z(), 1.0F);
  EXPECT_FLOAT_EQ(cloud.points_m[10 * 64 + 33].z(), 3.0F);
  EXPECT_FLOAT_EQ(cloud.points_m[10 * 64 + 33].x(), (33.0F - 31.5F) / 50.0F * 3.0F);
}

}  // namespace
}  // namespace limbcast::reconstructor
