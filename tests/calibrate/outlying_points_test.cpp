#include "modules/calibrate/outlying_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <tuple>

#include "modules/calibrate/report.hpp"
#include "modules/calibrate/stereo_fit.hpp"
#include "modules/calibrate/verdict.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/calibrate/found_cameras.hpp"

namespace limbcast::calibrate {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAreArray;

/// Which point of which image.
using Place = std::tuple<std::string, Side, int>;

std::vector<Place> places_of(const std::vector<OutlyingPoint>& points) {
  std::vector<Place> places;
  for (const OutlyingPoint& point : points) places.emplace_back(point.view, point.side, point.id);
  return places;
}

/// Moves one point of an image somewhere.
class Mover {
 public:
  Place move(View& view, Side side, double distance_px) {
    BoardPoints& points = side == Side::kLeft ? view.left : view.right;
    const int index = random_.uniform(0, static_cast<int>(points.ids.size()));
    const double direction = random_.uniform(0.0, 2.0 * CV_PI);
    points.pixels[index] +=
        cv::Point2f(cv::Point2d(std::cos(direction), std::sin(direction)) * distance_px);
    return {view.name, side, points.ids[index]};
  }
  /// In every second view, in the one image and the other.
  std::vector<Place> move_in_half(std::vector<View>& views, double distance_px) {
    std::vector<Place> moved;
    for (std::size_t i = 0; i < views.size(); i += 2)
      moved.push_back(move(views[i], i % 4 == 0 ? Side::kLeft : Side::kRight, distance_px));
    return moved;
  }

 private:
  cv::RNG random_{11};
};

/// What fit_stereo makes of views of which single points are wrong: the cameras, from all the views
/// and without just those points.
void expect_left_out(const std::vector<View>& views, const std::vector<Place>& wrong,
                     const Board& board, const StereoCalibration& truth) {
  const StereoFit fit = fit_stereo(views, board, kVga, truth.left.model);
  EXPECT_THAT(places_of(fit.outlying_points), UnorderedElementsAreArray(wrong));
  EXPECT_THAT(fit.outliers, IsEmpty());
  EXPECT_THAT(judge(fit, 0.8).faults, IsEmpty());
  expect_found(fit.calibration, truth);
}

TEST(OutlyingPoints, AreLeftOutOfRenderedViewsAndTheViewsKept) {
  const Board board;
  ViewCollector collector(board, false);
  for (const BoardPose& pose : varied_poses(board, 10))
    collector.add(render_board(board, pose, true_cameras(),
                               "view_" + std::to_string(collector.views().size())));
  for (const double distance_px : {5.0, 20.0}) {
    std::vector<View> views = collector.views();
    const std::vector<Place> wrong = Mover().move_in_half(views, distance_px);
    expect_left_out(views, wrong, board, true_cameras());
  }
}

TEST(OutlyingPoints, AreLeftOutWhereAViewHasHardlyMorePointsThanItNeeds) {
  Board board;
  board.kind = BoardKind::kCharuco;
  std::vector<View> views = project_boards(board, varied_poses(board, 14), true_cameras());
  // 3 x 4 points of each, all but the first ones'.
  for (std::size_t i = 4; i < views.size(); ++i) {
    for (BoardPoints* points : {&views[i].left, &views[i].right}) {
      const BoardPoints all = *points;
      *points = {};
      for (std::size_t k = 0; k < all.ids.size(); ++k) {
        if (all.ids[k] % board.columns >= 4 || all.ids[k] / board.columns >= 3) continue;
        points->ids.push_back(all.ids[k]);
        points->pixels.push_back(all.pixels[k]);
      }
    }
  }
  const std::vector<Place> wrong = Mover().move_in_half(views, 6.0);
  const StereoFit fit = fit_stereo(views, board, kVga);
  EXPECT_THAT(places_of(fit.outlying_points), UnorderedElementsAreArray(wrong));
  EXPECT_EQ(fit.views.size(), views.size());
}

TEST(OutlyingPoints, OfFisheyesAreLeftOut) {
  const Board board = large_board();
  std::vector<View> views = project_boards(board, poses_around(board), fisheye_cameras());
  const std::vector<Place> wrong = Mover().move_in_half(views, 5.0);
  expect_left_out(views, wrong, board, fisheye_cameras());
}

TEST(OutlyingPoints, AreNoneWhereOnlyNoiseMovesThePoints) {
  const Board board;
  for (const double sigma_px : {0.1, 0.5}) {
    std::vector<View> views;
    for (const BoardPose& pose : varied_poses(board, 12))
      views.push_back(project_board(board, pose, true_cameras(),
                                    "view_" + std::to_string(views.size()), sigma_px));
    EXPECT_THAT(places_of(fit_stereo(views, board, kVga).outlying_points), IsEmpty());
  }
}

TEST(OutlyingPoints, AreNoneWhereManyPointsOfAViewAreWrong) {
  const Board board;
  std::vector<View> views = project_boards(board, varied_poses(board, 12), true_cameras());
  // A row that slipped by a square.
  for (int id = 0; id < board.columns; ++id) views[3].left.pixels[id].x += 20.0F;
  const StereoFit fit = fit_stereo(views, board, kVga);
  EXPECT_THAT(places_of(fit.outlying_points), IsEmpty());
  ASSERT_EQ(fit.outliers.size(), 1U);
  EXPECT_EQ(fit.outliers[0].name, "view_3");
  expect_found(fit.calibration, true_cameras());
}

TEST(OutlyingPoints, AreToldByImageAndCounted) {
  StereoFit fit;
  fit.outlying_points = {
      {"a", Side::kLeft, 3, 5.0}, {"a", Side::kLeft, 7, 11.0}, {"a", Side::kRight, 3, 6.0}};
  EXPECT_EQ(left_out_table(fit.outlying_points),
            "a                     left out: 2 of the left image's points, up to 11.0 px from "
            "where the others put it\n"
            "a                     left out: 1 of the right image's points, up to 6.0 px from "
            "where the others put it\n");
  EXPECT_THAT(summary_text(fit, whole_images(kVga)),
              HasSubstr("0 views without 3 points that were left out: "));
  fit.outlying_points.clear();
  EXPECT_THAT(summary_text(fit, whole_images(kVga)), HasSubstr("0 views: "));
}

}  // namespace
}  // namespace limbcast::calibrate
