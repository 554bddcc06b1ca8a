#include "modules/calibrate/check.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "tests/calibrate/boards.hpp"

namespace {
int maps_made = 0;
}  // namespace

/// OpenCV's own, counted: a program's functions come before those of its libraries.
void cv::initUndistortRectifyMap(InputArray K, InputArray D, InputArray R, InputArray P, Size size,
                                 int type, OutputArray map1, OutputArray map2) {
  ++maps_made;
  static const auto original = reinterpret_cast<decltype(&cv::initUndistortRectifyMap)>(
      dlsym(RTLD_NEXT,
            "_ZN2cv23initUndistortRectifyMapERKNS_11_InputArrayES2_S2_S2_NS_5Size_IiEEiRKNS_"
            "12_OutputArrayES7_"));
  original(K, D, R, P, size, type, map1, map2);
}

namespace limbcast::calibrate {
namespace {

TEST(CalibrationCheck, MakesTheMapsOfRectificationOnceForAllPairs) {
  const StereoCalibration cameras = true_cameras();
  const GreyPair wall = picture_of_wall("wall", {640, 480});
  maps_made = 0;
  CalibrationCheck check(cameras, Board{});
  for (int i = 0; i < 3; ++i) check.add(wall);
  EXPECT_EQ(maps_made, 2);  // for the left and the right image
  EXPECT_EQ(check.result().pairs, 3);
}

TEST(CalibrationCheck, MakesNoMapsWherePointsOfABoardTellAll) {
  const Board board;
  const GreyPair pair = render_board(board, varied_poses(board, 1)[0], true_cameras(), "a");
  maps_made = 0;
  CalibrationCheck check(true_cameras(), board);
  check.add(pair);
  EXPECT_EQ(maps_made, 0);
  EXPECT_EQ(check.result().board_pairs, 1);
}

}  // namespace
}  // namespace limbcast::calibrate
