#include "modules/segmenter/scene/nearest_pixels.hpp"

#include <gtest/gtest.h>

#include <map>

namespace limbcast::segmenter {
namespace {

using Nearest = std::map<std::size_t, std::size_t>;

/// What is filled of a picture of 20 columns whose given pixels have a value, and from where.
Nearest filled(const std::vector<cv::Point>& with_value, int radius_px) {
  cv::Mat1b empty(10, 20, uchar{1});
  for (const cv::Point& pixel : with_value) empty(pixel) = 0;
  Nearest nearest;
  fill_from_nearest(empty, radius_px,
                    [&](std::size_t pixel, std::size_t from) { nearest[pixel] = from; });
  return nearest;
}

std::size_t pixel_at(int u, int v) { return static_cast<std::size_t>(20 * v + u); }

TEST(NearestPixels, FillAsFarAsTheRadius) {
  const Nearest nearest = filled({{12, 4}}, 2);
  EXPECT_EQ(nearest.at(pixel_at(14, 4)), pixel_at(12, 4));
  EXPECT_EQ(nearest.at(pixel_at(12, 2)), pixel_at(12, 4));
  EXPECT_EQ(nearest.at(pixel_at(11, 5)), pixel_at(12, 4));
  EXPECT_EQ(nearest.count(pixel_at(15, 4)), 0U);
  EXPECT_EQ(nearest.count(pixel_at(14, 6)), 0U);
  EXPECT_EQ(nearest.count(pixel_at(12, 4)), 0U);  // has a value itself
}

TEST(NearestPixels, TakeTheNearerOfTwo) {
  const Nearest nearest = filled({{3, 7}, {8, 7}}, 4);
  EXPECT_EQ(nearest.at(pixel_at(5, 7)), pixel_at(3, 7));
  EXPECT_EQ(nearest.at(pixel_at(6, 7)), pixel_at(8, 7));
}

TEST(NearestPixels, EndAtTheBorder) {
  const Nearest nearest = filled({{0, 0}, {19, 9}}, 3);
  EXPECT_EQ(nearest.at(pixel_at(3, 0)), pixel_at(0, 0));
  EXPECT_EQ(nearest.at(pixel_at(19, 6)), pixel_at(19, 9));
}

TEST(NearestPixels, AreNoneWhereNothingHasAValue) { EXPECT_TRUE(filled({}, 5).empty()); }

}  // namespace
}  // namespace limbcast::segmenter
