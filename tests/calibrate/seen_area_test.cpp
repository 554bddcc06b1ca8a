#include "modules/calibrate/seen_area.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "modules/calibrate/coverage.hpp"
#include "modules/calibrate/report.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/calibrate/found_cameras.hpp"

namespace limbcast::calibrate {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A scene of middling light in both images.
GreyPair picture_of_scene(uchar grey = 90) {
  const cv::Mat scene(kVga, CV_8UC1, cv::Scalar(grey));
  return {"scene", scene.clone(), scene.clone()};
}

cv::Mat circle_of(const PinholeCamera& camera, double radius_px) {
  cv::Mat circle(kVga, CV_8UC1, cv::Scalar(0));
  cv::circle(circle, {cvRound(camera.cx), cvRound(camera.cy)}, cvRound(radius_px), 255, cv::FILLED);
  return circle;
}

double share_lit(const cv::Mat& area) {
  return cv::countNonZero(area) / static_cast<double>(area.total());
}

/// All that is within 3 px of the circle's rim may be on either side.
void expect_image_circles(const SeenAreas& areas) {
  const StereoCalibration cameras = fisheye_cameras();
  for (const auto& [area, lens] :
       {std::pair(&areas.left, &cameras.left), std::pair(&areas.right, &cameras.right)}) {
    EXPECT_EQ(cv::countNonZero(circle_of(lens->camera, kImageCircle_px - 3.0) & ~*area), 0);
    EXPECT_EQ(cv::countNonZero(*area & ~circle_of(lens->camera, kImageCircle_px + 3.0)), 0);
  }
}

TEST(SeenArea, OfAFisheyeIsTheCircleThatItLights) {
  GreyPair pair = lit_in_image_circle(picture_of_scene());
  // Noise, and a reflection in a corner.
  pair.left.at<uchar>(3, 5) = 255;
  pair.left(cv::Rect(600, 30, 8, 8)).setTo(200);
  SeenAreaFinder finder;
  finder.add(pair.left, pair.right);
  expect_image_circles(finder.areas(LensModel::kFisheye));
}

TEST(SeenArea, IsKnownBetterWithEachPicture) {
  SeenAreaFinder finder;
  for (const int begin : {0, 200, 400}) {
    GreyPair pair = lit_in_image_circle(picture_of_scene());
    for (cv::Mat* image : {&pair.left, &pair.right}) {
      image->colRange(0, begin).setTo(0);
      image->colRange(std::min(640, begin + 240), 640).setTo(0);
    }
    finder.add(pair.left, pair.right);
  }
  expect_image_circles(finder.areas(LensModel::kFisheye));
}

TEST(SeenArea, HoldsWhereTheSceneIsDarkOnOneSide) {
  const cv::Size corner(200, 150);
  GreyPair pair = picture_of_scene();
  for (cv::Mat* image : {&pair.left, &pair.right}) (*image)(cv::Rect({0, 0}, corner)).setTo(0);
  SeenAreaFinder finder;
  finder.add(pair.left, pair.right);
  EXPECT_GT(share_lit(finder.areas(LensModel::kFisheye).left), 0.99);
}

TEST(SeenArea, OfADarkPictureIsAllOfIt) {
  const GreyPair pair = picture_of_scene(0);
  SeenAreaFinder finder;
  finder.add(pair.left, pair.right);
  EXPECT_EQ(share_lit(finder.areas(LensModel::kFisheye).left), 1.0);
}

TEST(SeenArea, OfAPinholeIsAllOfTheImage) {
  const GreyPair pair = lit_in_image_circle(picture_of_scene());
  SeenAreaFinder finder;
  finder.add(pair.left, pair.right);
  EXPECT_EQ(share_lit(finder.areas(LensModel::kPinhole).right), 1.0);
}

TEST(Coverage, CountsOnlyWhatTheLensSees) {
  const Board board = large_board();
  const StereoCalibration cameras = fisheye_cameras();
  const std::vector<View> views = project_boards(board, poses_in_image_circle(board), cameras);
  const SeenAreas circles{circle_of(cameras.left.camera, kImageCircle_px),
                          circle_of(cameras.right.camera, kImageCircle_px)};
  EXPECT_THAT(advise_places(views, circles), IsEmpty());
  EXPECT_THAT(advise_places(views, whole_images(kVga)), Contains(HasSubstr("top left")));
  EXPECT_NEAR(least_coverage(views, circles),
              least_coverage(views, whole_images(kVga)) / share_lit(circles.left), 0.01);
  EXPECT_TRUE(complete(views, board, circles, LensModel::kFisheye));
  EXPECT_FALSE(complete(views, board, whole_images(kVga), LensModel::kFisheye));
}

}  // namespace
}  // namespace limbcast::calibrate
