#include "modules/calibrate/views.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "common/input_error.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::calibrate {
namespace {

using ::testing::HasSubstr;

TEST(ChessboardCorners, AreExactThoughTheBoardStandsAtASlant) {
  const Board board;
  const BoardPose pose{{0.5, 0.5, 0.0}, {-0.1, -0.06, 0.55}};
  const BoardPoints truth = project_board(board, pose, true_cameras(), "slanted", 0.0).left;

  std::optional<BoardPoints> found =
      find_board(render_board(board, pose, true_cameras(), "slanted").left, board);

  ASSERT_TRUE(found);
  align_numbering(board, truth, *found);
  double sum_of_squares = 0.0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const cv::Point2f error_px = found->pixels[i] - truth.pixels[i];
    sum_of_squares += error_px.dot(error_px);
  }
  EXPECT_LT(std::sqrt(sum_of_squares / static_cast<double>(truth.pixels.size())), 0.07);
}

TEST(CirclesGrid, IsFoundThoughItIsTurnedAboutItsNormal) {
  Board board;
  board.kind = BoardKind::kCircles;
  const double middle_m = 0.5 * board.square_m;
  for (const int degrees : {0, 20, 45, 70}) {
    const double turn = degrees * CV_PI / 180.0;
    BoardPose pose{{0.0, 0.0, turn}, {0.0, 0.0, 0.6}};
    const double x = (board.columns - 1) * middle_m, y = (board.rows - 1) * middle_m;
    pose.translation_m[0] = -(std::cos(turn) * x - std::sin(turn) * y);
    pose.translation_m[1] = -(std::sin(turn) * x + std::cos(turn) * y);
    const cv::Mat picture = render_board(board, pose, true_cameras(), "turned").left;
    EXPECT_TRUE(find_board(picture, board)) << degrees;
  }
}

TEST(CharucoCorners, AreFoundThoughBitsOfMarkersAreMisread) {
  Board board;
  board.kind = BoardKind::kCharuco;
  for (const char* dictionary : {"4x4", "5x5", "6x6"}) {
    board.dictionary = dictionary;
    cv::Mat picture =
        render_board(board, {{0.3, 0.3, 0.0}, {-0.1, -0.07, 0.55}}, true_cameras(), "noisy").left;
    cv::GaussianBlur(picture, picture, {}, 0.7);
    cv::Mat noise(picture.size(), CV_16S);
    cv::theRNG().state = 1;
    cv::randn(noise, 0.0, 8.0);
    cv::add(picture, noise, picture, cv::noArray(), CV_8U);
    const std::optional<BoardPoints> found = find_board(picture, board);
    ASSERT_TRUE(found);
    EXPECT_GE(found->ids.size(), 48U) << dictionary;
  }
}

/// What becomes of pictures of one board pose that is carried about.
class Views : public ::testing::Test {
 protected:
  /// The board `right_px` further to the right in the image than at first, at `time_s`.
  GreyPair picture(const std::string& name, double right_px = 0.0, double time_s = 0.0) const {
    BoardPose pose = varied_poses(board_, 1)[0];
    pose.translation_m[0] += right_px * pose.translation_m[2] / true_cameras().left.camera.fx;
    GreyPair pair = render_board(board_, pose, true_cameras(), name);
    pair.utime = std::llround(1e6 * time_s);
    return pair;
  }
  std::string reason_for(ViewCollector& collector, const GreyPair& pair) const {
    return collector.add(pair) ? "" : collector.rejected().back().reason.text;
  }
  Board board_;
};

TEST_F(Views, OfAVideoAreTakenWhereTheBoardStandsStillAtANewPlace) {
  ViewCollector collector(board_, true);
  EXPECT_THAT(reason_for(collector, picture("a", 0.0, 0.0)), HasSubstr("just come into view"));
  EXPECT_EQ(reason_for(collector, picture("b", 0.5, 0.1)), "");
  EXPECT_THAT(reason_for(collector, picture("c", 0.6, 0.2)),
              HasSubstr("stands where it stood in b"));
  EXPECT_THAT(
      reason_for(collector, picture("d", 40.6, 0.3)),
      ::testing::ContainsRegex("moved by (3[6-9]|40)\\.. px in 0.10 s \\(limit 30 px/s\\)"));
  EXPECT_EQ(reason_for(collector, picture("e", 41.6, 0.4)), "");
  ASSERT_EQ(collector.views().size(), 2U);
  EXPECT_EQ(collector.views()[1].name, "e");
}

TEST_F(Views, OfAVideoAreNewWhereTheBoardIsTurnedInItsPlace) {
  const cv::Vec3d place_m(0.0, 0.0, 0.6);
  const auto tilted = [&](double degrees, double time_s) {
    BoardPose pose;
    pose.rotation = {0.0, degrees * CV_PI / 180.0, 0.0};
    pose.translation_m = place_m;
    GreyPair pair = render_board(board_, pose, true_cameras(), "");
    pair.utime = std::llround(1e6 * time_s);
    return pair;
  };
  ViewCollector collector(board_, true);
  collector.add(tilted(0.0, 0.0));
  ASSERT_TRUE(collector.add(tilted(0.0, 0.1)));
  collector.add(tilted(5.0, 1.0));
  EXPECT_THAT(reason_for(collector, tilted(5.0, 1.1)), HasSubstr("stands where it stood"));
  collector.add(tilted(-25.0, 1.2));
  EXPECT_EQ(reason_for(collector, tilted(-25.0, 1.3)), "");
}

TEST_F(Views, OfAVideoMayLieFarApartWhereTheBoardHardlyMoves) {
  // 6 px: motion within a tenth of a second, hands that hold still within half a second.
  ViewCollector fast(board_, true);
  fast.add(picture("a", 0.0, 0.0));
  EXPECT_THAT(reason_for(fast, picture("b", 6.0, 0.1)), HasSubstr("moved by"));
  ViewCollector slow(board_, true);
  slow.add(picture("a", 0.0, 0.0));
  EXPECT_EQ(reason_for(slow, picture("b", 6.0, 0.5)), "");
}

TEST_F(Views, OfAVideoWaitForAFrameAfterOneWithoutBoard) {
  ViewCollector collector(board_, true);
  collector.add(picture("a", 0.0, 0.0));
  const cv::Mat wall(480, 640, CV_8UC1, cv::Scalar(90));
  EXPECT_THAT(reason_for(collector, {"wall", wall, wall, 100'000}),
              HasSubstr("not found in the left"));
  EXPECT_THAT(reason_for(collector, picture("b", 0.0, 0.2)), HasSubstr("just come into view"));
}

TEST_F(Views, OfAVideoAreRefusedWhereTheyAreBlurredThoughTheBoardStandsStill) {
  ViewCollector collector(board_, true);
  collector.add(picture("a", 0.0, 0.0));
  GreyPair pair = picture("b", 0.0, 0.1);
  cv::GaussianBlur(pair.left, pair.left, {}, 3.0);
  EXPECT_THAT(reason_for(collector, pair), HasSubstr("blurred: edges in the left image"));
}

TEST_F(Views, OfSingleShotsAreTakenAtOnce) {
  ViewCollector collector(board_, false);
  EXPECT_EQ(reason_for(collector, picture("a")), "");
}

TEST_F(Views, OfSingleShotsAreNewWhereTheBoardHasMoved) {
  ViewCollector collector(board_, false);
  collector.add(picture("a"));
  EXPECT_EQ(reason_for(collector, picture("copy of a")), "stands where it stood in a");
  EXPECT_EQ(reason_for(collector, picture("b", 2.0)), "");
}

TEST_F(Views, AreRefusedWhereAnImageIsBlurred) {
  GreyPair pair = picture("a");
  cv::GaussianBlur(pair.right, pair.right, {}, 3.0);
  ViewCollector collector(board_, false);
  // From 10 to 90 % a Gaussian edge is 2.56 sigma wide.
  EXPECT_THAT(reason_for(collector, pair),
              ::testing::ContainsRegex(
                  "blurred: edges in the right image are ([6-9]|10)\\.. px wide \\(limit 5.0\\)"));
}

TEST_F(Views, AreRefusedWhereMotionBlursEdgesOfOneDirectionOnly) {
  for (const cv::Size& motion_px : {cv::Size(11, 1), cv::Size(1, 11)}) {
    GreyPair pair = picture("a");
    cv::blur(pair.right, pair.right, motion_px);
    ViewCollector collector(board_, false);
    EXPECT_THAT(reason_for(collector, pair), HasSubstr("blurred: edges in the right image"));
  }
}

TEST_F(Views, OfCirclesAreRefusedWhereBlurJoinsThemWithTheNext) {
  board_.kind = BoardKind::kCircles;
  const auto blurred = [](const GreyPair& sharp, const std::function<void(cv::Mat&)>& blur) {
    GreyPair pair{sharp.name, sharp.left, sharp.right.clone()};
    blur(pair.right);
    return pair;
  };
  // The circles' middles are 19 px from one another, on a larger board 30.
  for (const double larger : {1.0, 1.6}) {
    board_.square_m = larger * Board{}.square_m;
    board_.columns = 5;
    const GreyPair sharp = picture("a");
    const auto reason_of = [&](const std::function<void(cv::Mat&)>& blur) {
      ViewCollector collector(board_, false);
      return reason_for(collector, blurred(sharp, blur));
    };
    EXPECT_EQ(reason_of([](const cv::Mat&) {}), "");
    EXPECT_EQ(reason_of([&](cv::Mat& image) { cv::GaussianBlur(image, image, {}, 1.2 * larger); }),
              "");
    EXPECT_THAT(
        reason_of([&](cv::Mat& image) { cv::GaussianBlur(image, image, {}, 3.2 * larger); }),
        HasSubstr("blurred: edges in the right image"));
    const int motion = cvRound(11.0 * larger);
    for (const cv::Size& motion_px : {cv::Size(motion, 1), cv::Size(1, motion)})
      EXPECT_THAT(reason_of([&](cv::Mat& image) { cv::blur(image, image, motion_px); }),
                  HasSubstr("blurred: edges in the right image"));
  }
}

TEST_F(Views, AreNotCalledBlurredWhereSquaresAreTooSmallToTell) {
  BoardPose far = varied_poses(board_, 1)[0];
  far.translation_m = {0.0, 0.0, 1.7};
  ViewCollector collector(board_, false);
  EXPECT_EQ(reason_for(collector, render_board(board_, far, true_cameras(), "far")), "");
}

TEST_F(Views, AreRefusedWhereFewPointsAreInBothImages) {
  Board board;
  board.kind = BoardKind::kCharuco;
  GreyPair pair = render_board(board, varied_poses(board, 1)[0], true_cameras(), "a");
  // The right camera sees but the board's edge.
  pair.right(cv::Rect(0, 0, 250, 480)).setTo(120);
  ViewCollector collector(board, false);
  EXPECT_THAT(reason_for(collector, pair),
              ::testing::AnyOf(HasSubstr("points of the board, 12 are needed"),
                               HasSubstr("not found in the right image")));
}

TEST_F(Views, OfOtherSizeEndTheProgram) {
  ViewCollector collector(board_, false);
  collector.add(picture("a"));
  const cv::Mat small(48, 64, CV_8UC1, cv::Scalar(90));
  EXPECT_THAT(test::error_of<InputError>([&] {
                collector.add({"b", small, small});
              }),
              HasSubstr("b: an image is 64x48, the first one 640x480"));
}

}  // namespace
}  // namespace limbcast::calibrate
