#include "modules/segmenter/faces_and_joints/color_patch.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace limbcast::segmenter {
namespace {

const cv::Size kImage(40, 30);
const cv::Rect kHoleArea(12, 9, 15, 11);

cv::Mat1b hole() {
  cv::Mat1b marked(kImage, 0);
  marked(kHoleArea) = 1;
  return marked;
}

TEST(FillIn, GoesOnWithTheColorAround) {
  constexpr double kRounding = 1.0;
  const cv::Vec3b wall(40, 90, 200);
  cv::Mat3b image(kImage, wall);
  image(kHoleArea) = cv::Vec3b(255, 255, 255);
  fill_in(image, hole());
  EXPECT_LE(cv::norm(image, cv::Mat3b(kImage, wall), cv::NORM_INF), kRounding);
}

TEST(FillIn, RunsFromOneSideToTheOther) {
  constexpr double kTolerance = 18.0;  // three columns of 6 each
  cv::Mat3b ramp(kImage);
  for (int v = 0; v < ramp.rows; ++v) {
    for (int u = 0; u < ramp.cols; ++u) ramp(v, u) = cv::Vec3b::all(static_cast<uchar>(6 * u));
  }
  cv::Mat3b image = ramp.clone();
  image(kHoleArea) = cv::Vec3b(255, 255, 255);
  fill_in(image, hole());
  EXPECT_LT(cv::norm(image, ramp, cv::NORM_INF), kTolerance);
}

TEST(FillIn, ChangesNothingOutsideTheHole) {
  cv::Mat3b image(kImage);
  cv::randu(image, 0, 255);
  const cv::Mat3b before = image.clone();
  fill_in(image, hole());
  EXPECT_EQ(cv::norm(image, before, cv::NORM_INF, hole() == 0), 0.0);
}

TEST(FillIn, IsBlackWhereNothingIsKnown) {
  cv::Mat3b image(kImage, cv::Vec3b(40, 90, 200));
  fill_in(image, cv::Mat1b(kImage, 1));
  EXPECT_EQ(cv::norm(image), 0.0);
}

}  // namespace
}  // namespace limbcast::segmenter
