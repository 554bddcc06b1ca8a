#include "modules/calibrate/stereo_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "modules/calibrate/report.hpp"
#include "modules/calibrate/verdict.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/calibrate/found_cameras.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::calibrate {
namespace {

using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

StereoFit fit_rendered(const Board& board, int count) {
  ViewCollector collector(board, false);
  for (const BoardPose& pose : varied_poses(board, count))
    collector.add(render_board(board, pose, true_cameras(),
                               "view_" + std::to_string(collector.views().size())));
  EXPECT_GE(static_cast<int>(collector.views().size()), count * 3 / 4);
  return fit_stereo(collector.views(), board, collector.image_size());
}

TEST(StereoFit, FindsTheCamerasFromPicturesOfAChessboard) {
  const StereoFit fit = fit_rendered({}, 10);
  expect_found(fit.calibration, true_cameras());
  EXPECT_LT(fit.reprojection_px, 0.1);
  EXPECT_LT(fit.epipolar_px, 0.1);
}

TEST(StereoFit, FindsTheCamerasFromPicturesOfACharucoBoard) {
  Board board;
  board.kind = BoardKind::kCharuco;
  board.square_m = 0.03;
  board.marker_m = 0.021;
  const StereoFit fit = fit_rendered(board, 16);
  expect_found(fit.calibration, true_cameras());
}

TEST(StereoFit, FindsTheCamerasFromPicturesOfCircles) {
  Board board;
  board.kind = BoardKind::kCircles;
  const StereoFit fit = fit_rendered(board, 12);
  expect_found(fit.calibration, true_cameras());
}

TEST(StereoFit, FindsTheSameLensesInWhateverUnitTheSquaresAreTold) {
  Board board;
  const std::vector<View> views = project_boards(board, varied_poses(board, 14), true_cameras());
  for (const double factor : {0.004, 1000.0}) {
    board.square_m = factor * Board{}.square_m;
    StereoFit fit = fit_stereo(views, board, kVga);
    EXPECT_NEAR(fit.figures[0].distance_m / factor,
                fit_stereo(views, Board{}, kVga).figures[0].distance_m, 1e-3);
    fit.calibration.T /= factor;
    expect_found(fit.calibration, true_cameras());
  }
}

TEST(StereoFit, LeavesOutAViewWhoseBoardMovedBetweenTheImages) {
  const Board board;
  std::vector<View> views = project_boards(board, varied_poses(board, 14), true_cameras());
  for (cv::Point2f& pixel : views[5].right.pixels) pixel += {0.0F, 6.0F};
  const StereoFit fit = fit_stereo(views, board, kVga);
  ASSERT_EQ(fit.outliers.size(), 1U);
  EXPECT_EQ(fit.outliers[0].name, "view_5");
  EXPECT_THAT(fit.outliers[0].reason.text, HasSubstr("the board moved between the two images"));
  expect_found(fit.calibration, true_cameras());
}

TEST(StereoFit, LeavesOutViewsToWhichTheLensesCouldBend) {
  const Board board;
  for (const float moved_px : {4.0F, 12.0F}) {
    std::vector<View> views = project_boards(board, varied_poses(board, 10), true_cameras());
    for (cv::Point2f& pixel : views[3].right.pixels) pixel.x += moved_px;
    for (cv::Point2f& pixel : views[4].right.pixels) pixel.x += 0.5F * moved_px;
    const StereoFit fit = fit_stereo(views, board, kVga);
    std::vector<std::string> names;
    for (const RejectedView& view : fit.outliers) {
      names.push_back(view.name);
      EXPECT_THAT(view.reason.text, HasSubstr("the board moved between the two images"));
    }
    EXPECT_THAT(names, UnorderedElementsAre("view_3", "view_4"));
    expect_found(fit.calibration, true_cameras());
  }
}

TEST(StereoFit, LeavesK3OutWhereItWouldFoldTheImageBeyondTheBoards) {
  const Board board;
  StereoCalibration wide = true_cameras();
  for (LensCalibration* lens : {&wide.left, &wide.right}) {
    lens->camera.fx *= 0.62;
    lens->camera.fy *= 0.62;
  }
  std::vector<BoardPose> poses = varied_poses(board, 20);
  for (BoardPose& pose : poses) {
    pose.translation_m[0] *= 0.5;
    pose.translation_m[1] *= 0.5;
  }
  std::vector<View> views = project_boards(board, poses, wide);
  views[2].left.pixels[7].y += 9.0F;
  for (cv::Point2f& pixel : views[4].right.pixels) pixel.y += 5.0F;
  const StereoFit fit = fit_stereo(views, board, kVga);
  expect_found(fit.calibration, wide);
  // What the lens with k3 told of the views and points holds.
  EXPECT_EQ(fit.views.size() + 1, views.size());
  ASSERT_EQ(fit.outliers.size(), 1U);
  EXPECT_EQ(fit.outliers[0].name, "view_4");
  ASSERT_EQ(fit.outlying_points.size(), 1U);
  EXPECT_EQ(fit.outlying_points[0].view, "view_2");
  EXPECT_EQ(fit.calibration.left.distortion.at(4), 0.0);
  const Verdict verdict = judge(fit, VerdictParams{}.min_coverage);
  EXPECT_THAT(verdict.faults, IsEmpty());
  EXPECT_THAT(verdict.warnings, Contains(HasSubstr("the distortion has no k3")));
}

TEST(StereoFit, FindsTheCamerasFromABoardThatLooksTheSameOnItsSide) {
  Board board;
  board.columns = board.rows = 6;
  std::vector<View> views = project_boards(board, varied_poses(board, 14), true_cameras());
  // A detector begins at any corner.
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t turn = 0; turn < i % 4; ++turn) {
      std::vector<cv::Point2f>& pixels = views[i].right.pixels;
      const std::vector<cv::Point2f> before = pixels;
      for (int id = 0; id < board.num_points(); ++id)
        pixels[id] = before[(id % board.columns) * board.columns + 5 - id / board.columns];
    }
    align_numbering(board, views[i].left, views[i].right);
  }
  expect_found(fit_stereo(views, board, kVga).calibration, true_cameras());
}

TEST(StereoFit, NeedsViewsOfTheBoard) {
  const Board board;
  const std::vector<View> views = project_boards(board, varied_poses(board, 3), true_cameras());
  EXPECT_THAT(test::error_of<std::runtime_error>([&] { fit_stereo(views, board, kVga); }),
              HasSubstr("only 3 good views of the board, at least 5 are needed"));
}

TEST(StereoFit, MeasuresDistanceAndTiltOfTheBoard) {
  const Board board;
  const StereoFit fit =
      fit_stereo(project_boards(board, varied_poses(board, 12), true_cameras()), board, kVga);
  // The first pose is at z = 0.55 m, left of and above the middle, tipped by 0.25 rad or more.
  EXPECT_NEAR(fit.figures[0].distance_m, std::hypot(0.55, 0.55 * 0.25 - 0.06, 0.55 * 0.2), 0.005);
  EXPECT_GT(std::abs(fit.figures[0].tilt_updown_deg), 12.0);
}

StereoFit good_fit() {
  const Board board;
  return fit_stereo(project_boards(board, varied_poses(board, 12), true_cameras()), board, kVga);
}

TEST(Judge, AcceptsAGoodFit) {
  const StereoFit fit = good_fit();
  const Verdict verdict = judge(fit, 0.8);
  EXPECT_THAT(verdict.faults, IsEmpty());
  EXPECT_THAT(verdict.warnings, IsEmpty());
}

TEST(Judge, RefusesViewsThatAreAllParallelToTheImage) {
  const Board board;
  StereoCalibration cameras = true_cameras();
  cameras.left.distortion = cameras.right.distortion = {};
  const StereoFit fit =
      fit_stereo(project_boards(board, frontal_poses(board, 12), cameras), board, kVga);
  EXPECT_THAT(judge(fit, 0.8).faults, Contains(HasSubstr("only 0 views show the board tilted")));
}

TEST(Judge, RefusesCamerasThatAreSwapped) {
  const Board board;
  std::vector<View> views = project_boards(board, varied_poses(board, 12), true_cameras());
  for (View& view : views) std::swap(view.left, view.right);
  EXPECT_THAT(judge(fit_stereo(views, board, kVga), 0.8).faults, Contains(HasSubstr("swap them")));
}

TEST(Judge, RefusesWhereManyViewsDoNotFitWithTheOthers) {
  StereoFit fit = good_fit();
  fit.outliers.resize(4);
  EXPECT_THAT(judge(fit, 0.8).faults, IsEmpty());
  fit.outliers.resize(5);
  EXPECT_THAT(judge(fit, 0.8).faults,
              Contains(HasSubstr("5 of 17 views do not fit with the others (limit 25 %)")));
}

TEST(Judge, RefusesALensThatNoModuleWouldRead) {
  StereoFit fit = good_fit();
  fit.calibration.right.distortion = {-0.9, 0.0, 0.0, 0.0, 0.0};
  EXPECT_THAT(judge(fit, 0.8).faults,
              Contains(HasSubstr("right camera: its distortion folds the image")));
}

TEST(Judge, RefusesWhatNoRectifiedImageShows) {
  StereoFit fit = good_fit();
  for (ViewFit& view : fit.figures) view.num_rectified = 0;
  fit.epipolar_px = 0.0;
  EXPECT_THAT(judge(fit, 0.8).faults,
              Contains(HasSubstr("the rectified images show none of the boards")));
}

TEST(Judge, RefusesErrorsThatAreNoNumbers) {
  StereoFit fit = good_fit();
  fit.reprojection_px = fit.epipolar_px = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::string> faults = judge(fit, 0.8).faults;
  EXPECT_THAT(faults, Contains(HasSubstr("the reprojection error is nan px")));
  EXPECT_THAT(faults, Contains(HasSubstr("the epipolar error is nan px")));
}

TEST(Judge, RefusesWhatCoversLittleOfTheImage) {
  const StereoFit fit = good_fit();
  EXPECT_THAT(judge(fit, 0.2).faults, Contains(HasSubstr("the boards cover 20 % of the image")));
}

TEST(Judge, WarnsWhereCornersAreNotCovered) {
  const StereoFit fit = good_fit();
  const Verdict verdict = judge(fit, 0.3);
  EXPECT_THAT(verdict.faults, IsEmpty());
  EXPECT_THAT(verdict.warnings, Contains(HasSubstr("the boards cover 30 % of the image")));
}

TEST(Judge, WarnsWhereASquareWasToldInCentimetresOrMetres) {
  for (const double factor : {0.1, 1000.0}) {
    StereoFit fit = good_fit();
    fit.calibration.T *= factor;
    EXPECT_THAT(judge(fit, 0.8).warnings, Contains(HasSubstr("is --square-mm in millimetres?")));
  }
}

TEST(ViewTable, TellsNoEpipolarErrorOfWhatRectifiedImagesDoNotShow) {
  ViewFit seen;
  seen.name = "seen";
  seen.num_rectified = 54;
  seen.epipolar_px = 0.25;
  ViewFit outside;
  outside.name = "outside";
  const std::string table = view_table({seen, outside});
  EXPECT_THAT(table, ContainsRegex("\nseen( +[0-9.]+){3} +0\\.25 "));
  EXPECT_THAT(table, ContainsRegex("\noutside( +[0-9.]+){3} +- "));
}

TEST(Advise, AsksForNothingMoreWhenViewsAreVaried) {
  const Board board;
  const StereoFit fit =
      fit_stereo(project_boards(board, varied_poses(board, 24), true_cameras()), board, kVga);
  for (const std::string& sentence : advise(fit, whole_images(kVga)))
    EXPECT_THAT(sentence, ::testing::Not(HasSubstr("degrees")));
}

TEST(Advise, AsksForTiltDistanceAndEmptyParts) {
  const Board board;
  StereoCalibration cameras = true_cameras();
  std::vector<View> views = project_boards(board, varied_poses(board, 8), cameras);
  StereoFit fit = fit_stereo(views, board, kVga);
  fit.views = {views[0]};
  fit.figures = {fit.figures[0]};
  fit.figures[0].tilt_sideways_deg = fit.figures[0].tilt_updown_deg = 2.0;
  const std::vector<std::string> advice = advise(fit, whole_images(kVga));
  EXPECT_THAT(advice,
              Contains(HasSubstr("turn the board left and right by 20 to 45 degrees (0 of")));
  EXPECT_THAT(advice, Contains(HasSubstr("tip the board up and down")));
  EXPECT_THAT(advice, Contains(HasSubstr("nearer and farther")));
  EXPECT_THAT(advice, Contains(HasSubstr("left image: ")));
  EXPECT_THAT(advice, Contains(HasSubstr("bottom right")));
}

/// What a camera sees that watches as the board is held at one place after the other.
class Complete : public ::testing::Test {
 protected:
  std::vector<View> seen(const std::vector<BoardPose>& poses) const {
    return project_boards(board_, poses, true_cameras());
  }
  bool complete_with(const std::vector<View>& views) const {
    return complete(views, board_, whole_images(kVga), LensModel::kPinhole, params_);
  }
  /// Large, so that it stands far away: then both cameras see it at the image's edge too.
  Board board_ = [] {
    Board board;
    board.square_m = 0.05;
    return board;
  }();
  CompletionParams params_;
};

TEST_F(Complete, IsWhatShowsTheBoardEverywhereAndInAllWays) {
  const std::vector<View> views = seen(thorough_poses(board_));
  ASSERT_LT(static_cast<int>(views.size()), params_.most_views);
  EXPECT_TRUE(complete_with(views));
}

TEST_F(Complete, IsNotWhatHasFewViews) {
  std::vector<View> views = seen(thorough_poses(board_));
  params_.enough_views = static_cast<int>(views.size()) + 1;
  EXPECT_FALSE(complete_with(views));
}

TEST_F(Complete, IsNotWhatLeavesACornerOfTheImageEmpty) {
  std::vector<View> views = seen(thorough_poses(board_));
  params_.enough_views = 10;
  views.erase(views.begin());       // top left, near
  views.erase(views.begin() + 8);   // farther
  views.erase(views.begin() + 16);  // farthest
  EXPECT_FALSE(complete_with(views));
}

TEST_F(Complete, IsNotWhatShowsNoTilt) {
  std::vector<BoardPose> poses = thorough_poses(board_);
  for (BoardPose& pose : poses) pose.rotation = {};
  EXPECT_FALSE(complete_with(seen(poses)));
}

TEST_F(Complete, IsNotWhatWouldBeRefused) {
  std::vector<View> views = seen(thorough_poses(board_));
  for (View& view : views) std::swap(view.left, view.right);
  EXPECT_FALSE(complete_with(views));
}

TEST_F(Complete, IsWhatHasAllTheViewsThatWereAskedFor) {
  std::vector<View> views = seen(varied_poses(board_, 8));
  params_.most_views = 9;
  EXPECT_FALSE(complete_with(views));
  params_.most_views = 8;
  EXPECT_TRUE(complete_with(views));
}

}  // namespace
}  // namespace limbcast::calibrate
