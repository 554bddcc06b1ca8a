#include "modules/reconstructor/row_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "common/median.hpp"
#include "modules/reconstructor/reconstructor.hpp"
#include "tests/reconstructor/stereo_truth.hpp"
#include "tests/reconstructor/synthetic_pair.hpp"

namespace limbcast::reconstructor {
namespace {

const PinholeCamera kCamera = test::ideal_calibration().left.camera;
constexpr double kDisparity_px = 20.0;

/// A wall at a disparity of 20 px before a right camera that is turned.
RectifiedPair pair_of_turned_camera(const CameraTurn& turn) {
  const cv::Mat left = test::scene_texture();
  const Eigen::Matrix3d seen = (Eigen::AngleAxisd(turn.roll_rad, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(-turn.nod_rad, Eigen::Vector3d::UnitX()))
                                   .toRotationMatrix();
  const cv::Matx33d rotation(seen(0, 0), seen(0, 1), seen(0, 2), seen(1, 0), seen(1, 1), seen(1, 2),
                             seen(2, 0), seen(2, 1), seen(2, 2));
  const cv::Matx33d shift(1, 0, -kDisparity_px, 0, 1, 0, 0, 0, 1);
  const cv::Matx33d pixels(kCamera.fx, 0, kCamera.cx, 0, kCamera.fy, kCamera.cy, 0, 0, 1);
  cv::Mat right;
  cv::warpPerspective(left, right, pixels * rotation * pixels.inv() * shift, left.size(),
                      cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return {left, right};
}

/// The largest part of a pixel by which nine of ten corners miss their row or the wall's disparity.
double misfit_px(const RectifiedPair& pair) {
  std::vector<double> misfits_px;
  for (const CornerTrack& corner : track_corners(pair)) {
    const cv::Point2f step = corner.right - corner.left;
    misfits_px.push_back(std::hypot(step.x + kDisparity_px, step.y));
  }
  EXPECT_GT(misfits_px.size(), 100U);
  std::sort(misfits_px.begin(), misfits_px.end());
  return misfits_px.at(misfits_px.size() * 9 / 10);
}

TEST(RowAlignment, TellsHowTheRightCameraIsTurned) {
  const std::optional<CameraTurn> turn =
      find_right_turn(pair_of_turned_camera({0.004, -0.006, 0.0}), kCamera);
  ASSERT_TRUE(turn);
  EXPECT_NEAR(turn->nod_rad, 0.004, 0.0001);
  EXPECT_NEAR(turn->roll_rad, -0.006, 0.0001);
  EXPECT_NEAR(turn->shift_px, 0.0, 0.05);
}

TEST(RowAlignment, PutsRowsBackThatALensHasMoved) {
  RectifiedPair pair = pair_of_turned_camera({0.0, 0.0, 0.0});
  cv::warpAffine(pair.right.clone(), pair.right, cv::Matx23d(1, 0, 0, 0, 1, 2.4), pair.right.size(),
                 cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  ASSERT_GT(misfit_px(pair), 2.0);
  EXPECT_LT(misfit_px(with_rows_aligned(pair, kCamera)), 0.25);
}

TEST(RowAlignment, IsNotMovedByWhatMovesBetweenTheImages) {
  RectifiedPair pair = pair_of_turned_camera({0.002, 0.0, 0.0});
  const cv::Rect person(200, 60, 200, 400);
  const cv::Rect moved = person + cv::Point(0, 5);
  pair.right(person).clone().copyTo(pair.right(moved));
  const std::optional<CameraTurn> turn = find_right_turn(pair, kCamera);
  ASSERT_TRUE(turn);
  const CameraTurn off{turn->nod_rad - 0.002, turn->roll_rad, turn->shift_px};
  EXPECT_LT(row_shift_px(off, kCamera), 0.1);
}

TEST(RowAlignment, PutsWhatATurnedCameraSeesWhereItBelongs) {
  for (const CameraTurn& turn :
       {CameraTurn{0.004, 0.0, 0.0}, CameraTurn{0.0, 0.01, 0.0}, CameraTurn{-0.02, 0.01, 0.0}}) {
    const RectifiedPair pair = pair_of_turned_camera(turn);
    ASSERT_GT(misfit_px(pair), 1.5);
    const RectifiedPair aligned = with_rows_aligned(pair, kCamera);
    EXPECT_LT(misfit_px(aligned), 0.25) << turn.nod_rad << ", " << turn.roll_rad;
    EXPECT_EQ(aligned.left.data, pair.left.data);
  }
}

TEST(RowAlignment, LeavesRowsThatMatchAsTheyAre) {
  const RectifiedPair pair = pair_of_turned_camera({0.0001, 0.0001, 0.0});
  EXPECT_EQ(with_rows_aligned(pair, kCamera).right.data, pair.right.data);
}

TEST(RowAlignment, KnowsNothingWhereCornersDisagree) {
  RectifiedPair pair = pair_of_turned_camera({0.002, 0.0, 0.0});
  const cv::Mat before = pair.right.clone();
  constexpr int kSide = 40;
  cv::RNG random(3);
  for (int v = kSide; v + 2 * kSide <= before.rows; v += kSide)
    for (int u = 0; u + kSide <= before.cols; u += kSide)
      before(cv::Rect(u, v + random.uniform(-4, 5), kSide, kSide))
          .copyTo(pair.right(cv::Rect(u, v, kSide, kSide)));
  EXPECT_FALSE(find_right_turn(pair, kCamera));
}

TEST(RowAlignment, KnowsNothingOfAPlainWall) {
  const cv::Mat1b wall(480, 640, uchar{128});
  EXPECT_FALSE(find_right_turn({wall, wall}, kCamera));
  EXPECT_EQ(with_rows_aligned({wall, wall}, kCamera).right.data, wall.data);
}

TEST(RowAlignment, SeesAsMuchOfARecordingWithATurnedCalibration) {
  const std::string folder = test::stereo_dev_folder() + "/pointing";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const StereoCalibration calibration = test::read_calibration(folder);
  const auto points_of = [&](const StereoCalibration& with, const test::TrueFrame& frame) {
    const Cloud cloud = StereoReconstructor(with, {}).reconstruct({{}, frame.left, frame.right});
    std::size_t points = 0;
    for (std::size_t i = 0; i < cloud.points_m.size(); ++i) points += cloud.is_hole(i) ? 0 : 1;
    return static_cast<double>(points);
  };
  const std::vector<std::string> names = test::frame_names(folder);
  for (std::size_t i = 0; i < names.size(); i += 15) {
    const test::TrueFrame frame = test::read_true_frame(folder, names[i], 1.0);
    const double straight = points_of(calibration, frame);
    EXPECT_GT(points_of(test::turned(calibration, 0.0035, 0.0), frame), 0.96 * straight) << i;
    EXPECT_GT(points_of(test::turned(calibration, 0.0, 0.01), frame), 0.96 * straight) << i;
  }
}

}  // namespace
}  // namespace limbcast::reconstructor
