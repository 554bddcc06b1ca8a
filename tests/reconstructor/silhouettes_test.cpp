#include "modules/reconstructor/silhouettes.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace limbcast::reconstructor {
namespace {

constexpr float kNearPx = 30.0F, kFarPx = 10.0F;
const cv::Size kSize(160, 120);
const cv::Rect kThing(60, 40, 40, 40);

/// A dark thing before a light wall.
cv::Mat3b image_of_thing() {
  cv::Mat3b image(kSize, cv::Vec3b(180, 190, 200));
  image(kThing) = cv::Vec3b(40, 80, 60);
  return image;
}

/// Disparities of a thing that is matched wider by `seam_px` on all sides.
cv::Mat1f swollen_by(int seam_px) {
  cv::Mat1f disparity_px(kSize, kFarPx);
  disparity_px(kThing + cv::Size(2 * seam_px, 2 * seam_px) - cv::Point(seam_px, seam_px)) = kNearPx;
  return disparity_px;
}

TEST(TrimSilhouettes, TakesOffASeamUpToTheImagesEdge) {
  for (const int seam_px : {2, 6}) {
    cv::Mat1f disparity_px = swollen_by(seam_px);
    trim_silhouettes(image_of_thing(), {}, disparity_px);
    const cv::Mat1b is_near = disparity_px == kNearPx;
    EXPECT_EQ(cv::countNonZero(is_near(kThing)), kThing.area());
    // The outermost pixel of the edge may stay, and corners have no edge in their row or column.
    EXPECT_LE(cv::countNonZero(is_near), (kThing + cv::Size(2, 2)).area() + 4 * seam_px * seam_px);
    EXPECT_EQ(cv::countNonZero(disparity_px == kFarPx),
              cv::countNonZero(swollen_by(seam_px) == kFarPx));
  }
}

TEST(TrimSilhouettes, TakesOffSeamsInGreyImagesToo) {
  cv::Mat1b grey(kSize, uchar{190});
  grey(kThing) = 60;
  cv::Mat1f disparity_px = swollen_by(6);
  trim_silhouettes(grey, {}, disparity_px);
  EXPECT_EQ(disparity_px(60, 56), 0.0F);
  EXPECT_EQ(disparity_px(60, 60), kNearPx);
}

TEST(TrimSilhouettes, KeepsAThingThatNoEdgeEnds) {
  cv::Mat1f disparity_px = swollen_by(6);
  trim_silhouettes(cv::Mat3b(kSize, cv::Vec3b(120, 120, 120)), {}, disparity_px);
  EXPECT_EQ(cv::countNonZero(disparity_px != swollen_by(6)), 0);
}

TEST(TrimSilhouettes, KeepsAThingWhoseStripesAreStrongerThanItsOutline) {
  cv::Mat3b image(kSize, cv::Vec3b(90, 90, 90));
  image(kThing) = cv::Vec3b(140, 140, 140);
  for (int u = kThing.x + 4; u < kThing.br().x; u += 8)
    image.col(u).rowRange(kThing.y, kThing.br().y) = cv::Vec3b(10, 10, 10);
  SilhouetteParams params;
  params.max_color_ratio = 1e6F;  // edges alone decide
  cv::Mat1f disparity_px = swollen_by(0);
  trim_silhouettes(image, params, disparity_px);
  EXPECT_EQ(cv::countNonZero(disparity_px != swollen_by(0)), 0);
}

TEST(TrimSilhouettes, KeepsTheRimsOfHolesWithinASurface) {
  cv::Mat1f disparity_px(kSize, kNearPx);
  const cv::Rect hole(70, 50, 20, 20);
  disparity_px(hole) = 0.0F;
  const cv::Mat1f before = disparity_px.clone();
  cv::Mat3b image(kSize, cv::Vec3b(180, 190, 200));
  image(hole - cv::Point(4, 4) + cv::Size(8, 8)) = cv::Vec3b(40, 80, 60);  // ends on the surface
  trim_silhouettes(image, {}, disparity_px);
  EXPECT_EQ(cv::countNonZero(disparity_px != before), 0);
}

}  // namespace
}  // namespace limbcast::reconstructor
