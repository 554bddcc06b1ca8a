#include "modules/pose_fitter/refined/chamfer_distance.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace limbcast::pose_fitter {
namespace {

constexpr int kWidth = 61, kHeight = 47;

void expect_as_in_opencv(const cv::Mat& pixels) {
  cv::Mat expected;
  cv::distanceTransform(pixels, expected, cv::DIST_L2, 3);
  const auto distances = refined::chamfer_distance(
      {pixels.begin<std::uint8_t>(), pixels.end<std::uint8_t>()}, pixels.cols, pixels.rows);
  EXPECT_EQ(distances, std::vector<float>(expected.begin<float>(), expected.end<float>()));
}

TEST(ChamferDistance, IsOpenCvsToTheLastBit) {
  cv::Mat pixels(kHeight, kWidth, CV_8U, cv::Scalar(1));
  pixels.at<std::uint8_t>(11, 40) = 0;
  expect_as_in_opencv(pixels);
  cv::circle(pixels, {20, 30}, 9, 0, cv::FILLED);
  cv::circle(pixels, {21, 29}, 4, 1, cv::FILLED);
  expect_as_in_opencv(pixels);
  expect_as_in_opencv(1 - pixels);
}

TEST(ChamferDistance, IsFarWhereNoPixelIsZero) {
  expect_as_in_opencv(cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(1)));
}

}  // namespace
}  // namespace limbcast::pose_fitter
