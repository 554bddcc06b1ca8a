#include "modules/stereo_camera/swap_check.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/camera/calibration_reader.hpp"
#include "common/camera/recording.hpp"

namespace limbcast::stereo_camera {
namespace {

StereoCalibration parallel_cameras(double right_cx = 320.0) {
  StereoCalibration calibration;
  calibration.left.camera = {640, 480, 500.0, 500.0, 320.0, 240.0};
  calibration.right.camera = {640, 480, 500.0, 500.0, right_cx, 240.0};
  calibration.T = {-0.12, 0.0, 0.0};
  return calibration;
}

/// A textured plane in front of both cameras, whose points have this disparity.
struct Pair {
  cv::Mat left{480, 640, CV_8UC1}, right;
};
Pair textured_plane(int disparity_px) {
  cv::Mat scene(480, 640 + std::abs(disparity_px), CV_8UC1);
  cv::RNG noise(7);
  noise.fill(scene, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(scene, scene, {}, 4.0);
  cv::normalize(scene, scene, 0, 255, cv::NORM_MINMAX);
  const int left_from = disparity_px > 0 ? 0 : -disparity_px;
  const int right_from = disparity_px > 0 ? disparity_px : 0;
  return {scene.colRange(left_from, left_from + 640).clone(),
          scene.colRange(right_from, right_from + 640).clone()};
}

TEST(SwapCheck, AcceptsPicturesInOrder) {
  const Pair pair = textured_plane(20);
  const SwapEvidence evidence = compare_blocks(pair.left, pair.right, parallel_cameras());
  EXPECT_GT(evidence.blocks, 20);
  EXPECT_EQ(evidence.behind_infinity, 0);
  EXPECT_FALSE(looks_swapped(evidence));
}

TEST(SwapCheck, FindsPicturesThatAreSwapped) {
  const Pair pair = textured_plane(20);
  const SwapEvidence evidence = compare_blocks(pair.right, pair.left, parallel_cameras());
  EXPECT_EQ(evidence.behind_infinity, evidence.blocks);
  EXPECT_TRUE(looks_swapped(evidence));
}

TEST(SwapCheck, KnowsThatInfinityNeedNotHaveDisparityZero) {
  // The right principal point is 60 px to the right: infinity has disparity -60, this plane 40
  // more.
  const Pair pair = textured_plane(-20);
  EXPECT_FALSE(looks_swapped(compare_blocks(pair.left, pair.right, parallel_cameras(380.0))));
}

TEST(SwapCheck, SaysNothingWithoutTexture) {
  const cv::Mat wall(480, 640, CV_8UC1, cv::Scalar(128));
  const SwapEvidence evidence = compare_blocks(wall, wall, parallel_cameras());
  EXPECT_EQ(evidence.blocks, 0);
  EXPECT_FALSE(looks_swapped(evidence));
}

TEST(SwapCheck, IsRightOnEveryRecordedScene) {
  const std::string data = std::string(LIMBCAST_DATA_DIR) + "/stereo_dev";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";
  for (const char* name : {"multi", "nohuman", "distorted", "hd"}) {
    const std::string folder = data + "/" + name;
    const StereoCalibration calibration = read_stereo_calibration(folder + "/calibration.yml");
    const Recording recording = find_recording(folder, {"left", "right"}, {});
    for (std::size_t i = 0; i < recording.frames.size(); i += 4) {
      const cv::Mat left = cv::imread(recording.frames[i].first_path, cv::IMREAD_GRAYSCALE);
      const cv::Mat right = cv::imread(recording.frames[i].second_path, cv::IMREAD_GRAYSCALE);
      EXPECT_FALSE(looks_swapped(compare_blocks(left, right, calibration))) << name << i;
      EXPECT_TRUE(looks_swapped(compare_blocks(right, left, calibration))) << name << i;
    }
  }
}

}  // namespace
}  // namespace limbcast::stereo_camera
