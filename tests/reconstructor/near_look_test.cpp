#include "modules/reconstructor/near_look.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "modules/reconstructor/reconstructor.hpp"
#include "tests/reconstructor/synthetic_pair.hpp"

namespace limbcast::reconstructor {
namespace {

constexpr int kWallDisparity = 20, kHandDisparity = 100;
constexpr int kUsual = 61, kMost = 151;
constexpr int kHandLeft = 300, kHandTop = 200;

using Brightness = std::function<double(double u, double v)>;

/// A wall, and a square hand before it.
RectifiedPair pair_with_hand(const Brightness& wall, int hand_px,
                             int wall_disparity = kWallDisparity, int hand_left = kHandLeft,
                             int hand_disparity = kHandDisparity) {
  const test::Texture skin;
  const auto brightness = [&](int u, int v, int wall_shift, int hand_shift) {
    const int hand_u = u + hand_shift - hand_left, hand_v = v - kHandTop;
    const bool on_hand = hand_u >= 0 && hand_u < hand_px && hand_v >= 0 && hand_v < hand_px;
    return cv::saturate_cast<uchar>(on_hand ? skin(hand_u, hand_v) : wall(u + wall_shift, v));
  };
  RectifiedPair pair{cv::Mat1b(480, 640), cv::Mat1b(480, 640)};
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      pair.left.at<uchar>(v, u) = brightness(u, v, 0, 0);
      pair.right.at<uchar>(v, u) = brightness(u, v, wall_disparity, hand_disparity);
    }
  }
  return pair;
}

double plain_wall(double u, double v) {
  static const test::Texture texture;
  return texture(u + 700.0, v);
}

TEST(NearLook, SearchesAsUsualWhereNothingIsNear) {
  EXPECT_EQ(find_num_disparities(pair_with_hand(plain_wall, 0), kUsual, kMost), kUsual);
}

TEST(NearLook, SearchesAsFarAsANearHandNeeds) {
  const int searched = find_num_disparities(pair_with_hand(plain_wall, 60), kUsual, kMost);
  EXPECT_GT(searched, kHandDisparity);
  EXPECT_LT(searched, kHandDisparity + 20);
}

TEST(NearLook, SearchesNoFartherThanItMay) {
  constexpr int kLess = kHandDisparity + 3;
  EXPECT_EQ(find_num_disparities(pair_with_hand(plain_wall, 60), kUsual, kUsual), kUsual);
  EXPECT_LE(find_num_disparities(pair_with_hand(plain_wall, 60), kUsual, kLess), kLess);
}

TEST(NearLook, MindsNoSpecks) {
  EXPECT_EQ(find_num_disparities(pair_with_hand(plain_wall, 12), kUsual, kMost), kUsual);
}

TEST(NearLook, IsNotMisledByWallpaperThatRepeatsItself) {
  // In images of a quarter of the size the true disparity, 5.5, fits worse than the next, 24.6.
  constexpr int kDisparity = 22;
  constexpr double kPeriod_px = 4.0 * 24.6 - kDisparity;
  const auto wallpaper = [&](double u, double v) {
    return plain_wall(std::fmod(u, kPeriod_px), v);
  };
  EXPECT_EQ(find_num_disparities(pair_with_hand(wallpaper, 0, kDisparity), kUsual, kMost), kUsual);
}

/// Share of the hand's inner pixels whose disparity is found to half a pixel.
double share_right(const DisparityImage& disparity, int hand_left, int hand_disparity) {
  const cv::Rect inner(hand_left + 10, kHandTop + 10, 40, 40);
  const cv::Mat1f error = cv::abs(disparity.disparity_px(inner) - hand_disparity);
  return static_cast<double>(cv::countNonZero(error < 0.5F)) / inner.area();
}

TEST(StereoReconstructor, SeesAHandThatIsNearerThanMostThings) {
  const StereoReconstructor reconstructor(test::ideal_calibration(), {});
  const DisparityImage disparity = reconstructor.match(pair_with_hand(plain_wall, 60));
  EXPECT_GT(share_right(disparity, kHandLeft, kHandDisparity), 0.95);
}

TEST(StereoReconstructor, SeesAHandWithMoreDisparitiesThanTheMatcherSearches) {
  StereoCalibration wide = test::ideal_calibration();
  wide.T = {-0.5, 0.0, 0.0};
  constexpr int kLeft = 420, kNearDisparity = kMaxDisparities + 129;
  const DisparityImage disparity = StereoReconstructor(wide, {}).match(
      pair_with_hand(plain_wall, 60, kWallDisparity, kLeft, kNearDisparity));
  EXPECT_GT(share_right(disparity, kLeft, kNearDisparity), 0.95);
}

TEST(StereoReconstructor, SearchesNoFartherThanTheImageIsWide) {
  StereoCalibration wide = test::ideal_calibration();
  wide.T = {-0.7, 0.0, 0.0};
  const StereoReconstructor reconstructor(wide, {});
  EXPECT_EQ(reconstructor.most_disparities(), 640);
  EXPECT_GT(reconstructor.nearest_m(), ReconstructorOptions{}.stereo_near_limit_m());
}

}  // namespace
}  // namespace limbcast::reconstructor
