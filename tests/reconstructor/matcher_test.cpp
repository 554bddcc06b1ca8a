#include "modules/reconstructor/matcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <vector>

#include "common/median.hpp"
#include "tests/reconstructor/synthetic_pair.hpp"

namespace limbcast::reconstructor {
namespace {

/// A wall that comes nearer from left to right and a square before it.
double wall_and_square(int u, int v) {
  if (std::abs(u - 320) < 80 && std::abs(v - 240) < 80) return 40.0;
  return 10.0 + 0.01 * u;
}

TEST(Match, GivesTheSameOnAnyNumberOfThreads) {
  const RectifiedPair pair = test::pair_of(wall_and_square);
  const int before = cv::getNumThreads();
  cv::setNumThreads(1);
  const cv::Mat1f one = match(pair.left, pair.right).disparity_px;
  cv::setNumThreads(4);
  const cv::Mat1f four = match(pair.left, pair.right).disparity_px;
  cv::setNumThreads(before);
  EXPECT_EQ(cv::countNonZero(one != four), 0);
}

TEST(Match, FindsFractionsWithoutPreferenceForWholeDisparities) {
  // Columns 50 to 549 lie at 10.5 to 15.5 px: every fraction is equally frequent.
  const auto slope = [](int u, int) { return 10.0 + 0.01 * u; };
  const RectifiedPair pair = test::pair_of(slope);
  const cv::Mat1f found = match(pair.left, pair.right).disparity_px;
  std::vector<int> histogram(8, 0);
  std::vector<float> errors_px;
  for (int v = 20; v < 460; ++v) {
    for (int u = 50; u < 550; ++u) {
      const float disparity_px = found(v, u);
      if (disparity_px <= 0.0F) continue;
      ++histogram.at(static_cast<std::size_t>(8.0F * (disparity_px - std::floor(disparity_px))));
      errors_px.push_back(std::abs(disparity_px - static_cast<float>(slope(u, v))));
    }
  }
  ASSERT_GT(errors_px.size(), 440U * 500U * 99U / 100U);
  const auto middle = errors_px.begin() + static_cast<std::ptrdiff_t>(errors_px.size() / 2);
  std::nth_element(errors_px.begin(), middle, errors_px.end());
  EXPECT_LT(*middle, 0.03F);
  // OpenCV's matcher puts four times the equal share into one of sixteen bins, a sixth into
  // another.
  const double equal_share = static_cast<double>(errors_px.size()) / 8.0;
  for (const int count : histogram) EXPECT_NEAR(count, equal_share, 0.35 * equal_share);
}

TEST(Match, IsAsExactWhereOneImageIsDarker) {
  const auto slope = [](int u, int) { return 10.0 + 0.01 * u; };
  RectifiedPair pair = test::pair_of(slope);
  const auto median_error_px = [&] {
    const cv::Mat1f found = match(pair.left, pair.right).disparity_px;
    std::vector<float> errors_px;
    for (int v = 20; v < 460; ++v)
      for (int u = 50; u < 550; ++u)
        errors_px.push_back(std::abs(found(v, u) - static_cast<float>(slope(u, v))));
    return median(errors_px);
  };
  const float alike_px = median_error_px();
  pair.right *= 0.7;
  EXPECT_LT(median_error_px(), 1.1F * alike_px);
}

TEST(Match, KeepsTheOutlineOfASquareBeforeAWall) {
  const RectifiedPair pair = test::pair_of(wall_and_square);
  const cv::Mat1f found = match(pair.left, pair.right).disparity_px;
  const cv::Mat1b is_near = found > 30.0F;
  EXPECT_NEAR(cv::countNonZero(is_near), 159 * 159, 0.05 * 159 * 159);
}

constexpr int kThingDisparityPx = 40, kWallDisparityPx = 10;  ///< disparities

/// A thing before a wall; told where it is in the left image and how bright each is there.
template <class Shape, class Thing, class Wall>
RectifiedPair thing_before_wall(const Shape& is_thing, const Thing& on_thing, const Wall& on_wall) {
  RectifiedPair pair{cv::Mat1b(480, 640), cv::Mat1b(480, 640)};
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const auto seen_at = [&](int thing_px, int wall_px) {
        return cv::saturate_cast<uchar>(is_thing(cv::Point(u + thing_px, v))
                                            ? on_thing(u + thing_px, v)
                                            : on_wall(u + wall_px, v));
      };
      pair.left.at<uchar>(v, u) = seen_at(0, 0);
      pair.right.at<uchar>(v, u) = seen_at(kThingDisparityPx, kWallDisparityPx);
    }
  }
  return pair;
}

double textured(int u, int v) {
  static const test::Texture kTexture;
  return kTexture(u, v);
}

double dark_texture(int u, int v) { return 0.5 * textured(u, v); }

/// Only its margins have a texture.
double bare_wall(int u, int v) {
  return cv::Rect(120, 80, 400, 320).contains({u, v}) ? 128.0 : textured(u, v);
}

TEST(Match, TakesTheEvenWallBesideASquareForTheWall) {
  const cv::Rect square(240, 160, 160, 160);
  const RectifiedPair pair = thing_before_wall(
      [&](cv::Point pixel) { return square.contains(pixel); }, dark_texture, bare_wall);
  const cv::Mat1f found = match(pair.left, pair.right).disparity_px;
  EXPECT_NEAR(cv::countNonZero(found > 30.0F), square.area(), 0.05 * square.area());
}

TEST(Match, TakesTheEvenWallBetweenAnArmAndTheTrunkForTheWall) {
  const cv::Rect body(260, 140, 120, 200), gap(290, 200, 60, 90);
  const RectifiedPair pair = thing_before_wall(
      [&](cv::Point pixel) { return body.contains(pixel) && !gap.contains(pixel); }, dark_texture,
      bare_wall);
  const cv::Mat1f found = match(pair.left, pair.right).disparity_px;
  EXPECT_LT(cv::countNonZero(found(gap) > 30.0F), 0.25 * gap.area());
}

TEST(Match, LeavesWhatIsEvenWhereItsOutlineIs) {
  // As a dark suit's leg or sleeve: nothing within it tells how far off it is.
  const cv::Rect leg(290, 160, 60, 160);
  const RectifiedPair pair = thing_before_wall([&](cv::Point pixel) { return leg.contains(pixel); },
                                               [](int, int) { return 12.0; }, textured);
  const cv::Mat1f found = match(pair.left, pair.right).disparity_px;
  const cv::Mat1b right_place = cv::abs(found(leg) - 1.0F * kThingDisparityPx) < 1.0F;
  EXPECT_GT(cv::countNonZero(right_place), 0.95 * leg.area());
}

TEST(Match, FindsTheDepthOfABarAsThickAsAnArm) {
  // Windows reach over its edges, where the wall behind shifts less from image to image.
  constexpr double kLeft = 300.0, kRight = 316.0, kBarPx = 24.4, kWallPx = 12.0;
  const test::Texture texture;
  RectifiedPair pair{cv::Mat1b(480, 640), cv::Mat1b(480, 640)};
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const auto seen_at = [&](double bar_px, double wall_px) {
        const bool on_bar = u + bar_px >= kLeft && u + bar_px < kRight;
        return cv::saturate_cast<uchar>(on_bar ? 0.6 * texture(v, u + bar_px)
                                               : texture(u + wall_px, v));
      };
      pair.left.at<uchar>(v, u) = seen_at(0.0, 0.0);
      pair.right.at<uchar>(v, u) = seen_at(kBarPx, kWallPx);
    }
  }
  const cv::Mat1f found = match(pair.left, pair.right).disparity_px;
  std::vector<float> errors_px;
  for (int v = 20; v < 460; ++v) {
    for (int u = 300; u < 316; ++u) {
      const float error_px = found(v, u) - static_cast<float>(kBarPx);
      if (found(v, u) > 0.0F && std::abs(error_px) < 1.5F) errors_px.push_back(error_px);
    }
  }
  ASSERT_GT(errors_px.size(), 440U * 14U);
  const double sum_px = std::accumulate(errors_px.begin(), errors_px.end(), 0.0);
  EXPECT_NEAR(sum_px / static_cast<double>(errors_px.size()), 0.0, 0.05);
}

TEST(Match, LeavesWhatOnlyTheLeftCameraSees) {
  const RectifiedPair pair = test::pair_of([](int, int) { return 32.0; });
  const cv::Mat1f found = match(pair.left, pair.right).disparity_px;
  EXPECT_EQ(cv::countNonZero(found.colRange(0, 31)), 0);
}

TEST(Match, SearchesNumbersOfDisparitiesThatFillNoRegister) {
  const RectifiedPair pair = test::pair_of([](int, int) { return 32.0; });
  MatcherParams params;
  for (const int num_disparities : {33, 34, 50, 65}) {
    params.semi_global.num_disparities = num_disparities;
    const cv::Mat1f found = match(pair.left, pair.right, params).disparity_px;
    const cv::Mat1b is_right = cv::abs(found - 32.0F) < 0.5F;
    EXPECT_GT(cv::countNonZero(is_right.colRange(40, 630)), 0.99 * 480 * 590) << num_disparities;
  }
}

TEST(Match, RefusesImagesOfDifferentSizes) {
  EXPECT_THROW(match(cv::Mat1b(48, 64, uchar{0}), cv::Mat1b(48, 60, uchar{0})),
               std::invalid_argument);
}

TEST(SemiGlobal, RefusesMoreDisparitiesThanAByteHolds) {
  SemiGlobalParams params;
  params.num_disparities = 256;
  EXPECT_THROW(
      match_semi_global(cv::Mat1b(48, 640, uchar{0}), cv::Mat1b(48, 640, uchar{0}), params),
      std::invalid_argument);
}

TEST(Match, FindsNothingInImagesWithoutTexture) {
  const cv::Mat1b grey(48, 640, uchar{128});
  EXPECT_EQ(cv::countNonZero(match(grey, grey).disparity_px), 0);
}

}  // namespace
}  // namespace limbcast::reconstructor
