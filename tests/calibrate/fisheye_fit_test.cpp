#include "modules/calibrate/fisheye_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "common/camera/opencv_conversion.hpp"
#include "modules/calibrate/coverage.hpp"
#include "modules/calibrate/stereo_fit.hpp"
#include "modules/calibrate/verdict.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/calibrate/found_cameras.hpp"

namespace limbcast::calibrate {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<View> projected_views(const Board& board) {
  return project_boards(board, poses_around(board), fisheye_cameras());
}

StereoFit fit(const std::vector<View>& views) {
  return fit_stereo(views, large_board(), kVga, LensModel::kFisheye);
}

TEST(FisheyeFit, FindsTheCamerasFromPicturesOfAChessboard) {
  const Board board = large_board();
  ViewCollector collector(board, false);
  const std::vector<BoardPose> poses = poses_around(board);
  for (std::size_t i = 0; i < poses.size(); i += 2)
    collector.add(render_board(board, poses[i], fisheye_cameras(),
                               "view_" + std::to_string(collector.views().size())));
  ASSERT_GE(collector.views().size(), 10U);
  const StereoFit found = fit(collector.views());
  expect_found(found.calibration, fisheye_cameras());
  EXPECT_LT(found.reprojection_px, 0.1);
  EXPECT_LT(found.epipolar_px, 0.15);  // at their borders rectified images are stretched
  EXPECT_GT(found.left.focal_px, 0.0);
  EXPECT_LT(found.left.focal_px, 1.0);
  const Verdict verdict = judge(found, least_coverage(found.views, whole_images(kVga)));
  EXPECT_THAT(verdict.faults, IsEmpty());
  EXPECT_THAT(verdict.warnings, IsEmpty());
}

TEST(FisheyeFit, FindsTheCoefficientsAndHowTheBoardStood) {
  const StereoFit found = fit(projected_views(large_board()));
  expect_found(found.calibration, fisheye_cameras());
  // The polynomial, at 1 rad, to a pixel in a hundred.
  const auto sum = [](const std::vector<double>& k) { return k[0] + k[1] + k[2] + k[3]; };
  EXPECT_NEAR(sum(found.calibration.left.distortion), 0.004, 0.002);
  EXPECT_NEAR(sum(found.calibration.right.distortion), 0.013, 0.002);
  // 9 squares of 5 cm from a place between the cameras, or 13.
  for (const ViewFit& view : found.figures) {
    const double nearest_m = view.distance_m < 0.55 ? 0.45 : 0.65;
    EXPECT_NEAR(view.distance_m, nearest_m, 0.06);
  }
}

TEST(FisheyeFit, LeavesOutAViewWhoseBoardMovedBetweenTheImages) {
  std::vector<View> views = projected_views(large_board());
  for (cv::Point2f& pixel : views[5].right.pixels) pixel += {4.0F, 2.0F};
  const StereoFit found = fit(views);
  ASSERT_EQ(found.outliers.size(), 1U);
  EXPECT_EQ(found.outliers[0].name, views[5].name);
  EXPECT_THAT(found.outliers[0].reason.text, HasSubstr("the board moved between the two images"));
  expect_found(found.calibration, fisheye_cameras());
}

TEST(FisheyeFit, LeavesTermsOutWhereTheyWouldFoldTheImageBeyondTheBoards) {
  // All near the middle, and with the noise of a poor camera: k3 and k4 are a guess.
  const Board board = large_board();
  std::vector<View> views;
  for (const BoardPose& pose : varied_poses(board, 12))
    views.push_back(
        project_board(board, pose, fisheye_cameras(), "view_" + std::to_string(views.size()), 0.3));
  const StereoFit found = fit(views);
  EXPECT_EQ(found.calibration.left.distortion[2], 0.0);
  EXPECT_EQ(found.calibration.left.distortion[3], 0.0);
  EXPECT_THAT(
      judge(found, 0.8).warnings,
      Contains(HasSubstr("the distortion has no k3 and k4: with them the image would fold")));
}

/// A board and where a lens shows it.
struct SeenBoard {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  cv::Vec3d rotation, translation;  ///< of the board [sides of a square]
};

SeenBoard seen_board(const Board& board, const cv::Vec3d& rotation, const cv::Vec3d& translation,
                     const LensCalibration& lens) {
  SeenBoard seen{{}, {}, rotation, translation};
  for (int id = 0; id < board.num_points(); ++id)
    seen.points.emplace_back(point_in_squares(board, id));
  cv::fisheye::projectPoints(seen.points, seen.pixels, rotation, translation,
                             camera_matrix(lens.camera), lens.distortion);
  return seen;
}

/// Without any steps but the first that is tried.
FitParams hardly_fitted() {
  FitParams params;
  params.max_iterations = 1;
  return params;
}

class FisheyePose : public ::testing::Test {
 protected:
  std::vector<SeenBoard> boards_around() const {
    std::vector<SeenBoard> boards;
    for (const BoardPose& pose : poses_around(board_))
      boards.push_back(
          seen_board(board_, pose.rotation, pose.translation_m / board_.square_m, lens_));
    return boards;
  }
  Pose found(const SeenBoard& seen, const std::optional<Pose>& guess,
             const FitParams& params) const {
    return fisheye_pose(seen.points, seen.pixels, lens_, guess, params);
  }
  void expect_pose(const Pose& pose, const SeenBoard& seen) const {
    EXPECT_LT(cv::norm(pose.translation, seen.translation), 1e-4);
    EXPECT_LT(cv::norm(pose.rotation, seen.rotation), 1e-5);
  }
  Board board_ = large_board();
  LensCalibration lens_ = fisheye_cameras().left;
};

TEST_F(FisheyePose, IsFoundFarOffTheAxis) {
  for (const SeenBoard& seen : boards_around()) expect_pose(found(seen, {}, {}), seen);
}

TEST_F(FisheyePose, BeginsWithTheGuess) {
  for (const SeenBoard& seen : boards_around()) {
    const Pose truth{cv::Mat(seen.rotation, true), cv::Mat(seen.translation, true)};
    expect_pose(found(seen, truth, hardly_fitted()), seen);
  }
}

TEST_F(FisheyePose, BeginsNearTheBoardWithoutAGuess) {
  // 75 degrees off the axis, and 20 squares away.
  for (const double angle_rad : {-1.3, 1.3}) {
    const cv::Vec3d rotation(0.0, angle_rad, 0.0);
    cv::Matx33d turn;
    cv::Rodrigues(rotation, turn);
    const SeenBoard seen = seen_board(board_, rotation, turn * cv::Vec3d(-4.0, -2.5, 20.0), lens_);
    const Pose pose = found(seen, {}, hardly_fitted());
    EXPECT_LT(cv::norm(pose.translation, seen.translation), 0.1);
    EXPECT_LT(cv::norm(pose.rotation, seen.rotation), 0.01);
  }
}

TEST_F(FisheyePose, BeginsNearABoardWhoseBorderIsNearly90DegreesOffTheAxis) {
  // 69 degrees off at its middle and 10 squares away. Along the axis tangents of the border's rays
  // would be as large as its noise makes them.
  cv::RNG random(5);
  for (const double angle_rad : {-1.2, 1.2}) {
    const cv::Vec3d rotation(0.0, angle_rad, 0.0);
    cv::Matx33d turn;
    cv::Rodrigues(rotation, turn);
    SeenBoard seen = seen_board(board_, rotation, turn * cv::Vec3d(-4.0, -2.5, 10.0), lens_);
    for (cv::Point2d& pixel : seen.pixels)
      pixel += cv::Point2d(random.gaussian(0.3), random.gaussian(0.3));
    const Pose pose = found(seen, {}, hardly_fitted());
    EXPECT_LT(cv::norm(pose.translation, seen.translation), 0.1);
    EXPECT_LT(cv::norm(pose.rotation, seen.rotation), 0.02);
  }
}

}  // namespace
}  // namespace limbcast::calibrate
