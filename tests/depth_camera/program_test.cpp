#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limbcast/body_poses_t.hpp>
#include <limbcast/depth_images_t.hpp>

#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/depth_images_codec.hpp"
#include "tests/stereo_camera/recorded_pairs.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kWrongInput = 2;

cv::Mat depth_ramp() {
  cv::Mat depth(kHeight, kWidth, CV_16UC1);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    depth.at<std::uint16_t>(i / kWidth, i % kWidth) = static_cast<std::uint16_t>(20 * i);
  }
  return depth;
}

class DepthCameraProgram : public ::testing::Test {
 protected:
  DepthCameraProgram() {
    write_text(calibration_,
               "%YAML:1.0\n---\nimage_width: 64\nimage_height: 48\ndepth_scale: 0.0005\n"
               "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
               "   data: [ 50., 0., 32., 0., 51., 24., 0., 0., 1. ]\n");
    testing::write_bytes(folder_ + "/a_color.jpg",
                         encode_jpeg(testing::grey_picture(kWidth, kHeight, 80), 95));
    testing::write_bytes(folder_ + "/a_depth.png", encode_png(depth_ramp()));
  }
  RunResult write_log(const std::vector<std::string>& options) const {
    std::vector<std::string> words = {program("limbcast-depth-camera"), "--calibration",
                                      calibration_, "--log", log_};
    words.insert(words.end(), options.begin(), options.end());
    return run(words);
  }
  std::string error(const std::vector<std::string>& options) const {
    const RunResult result = write_log(options);
    EXPECT_EQ(result.exit_code, kWrongInput) << result.output;
    return result.output;
  }
  std::string folder_ = temporary_folder("frames");
  std::string calibration_ = folder_ + "/calibration.yml";
  std::string log_ = temporary_folder("log") + "/in.log";
};

TEST_F(DepthCameraProgram, WritesFramesWithTheirCalibration) {
  write_text(folder_ + "/a_gt.json", R"({"utime": 5, "persons": []})");

  const RunResult result = write_log({"--source", folder_, "--start-time-s", "7"});

  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto events = events_of(log_);
  ASSERT_THAT(channels_of(events), ElementsAre("DEPTH_IMAGES", "GROUND_TRUTH"));
  const auto frame = lcm_io::from_message(lcm_io::decode<depth_images_t>(events[0].data));
  EXPECT_EQ(frame.images.stamp.utime, 7'000'000);
  EXPECT_EQ(frame.images.stamp.gravity.source, GravitySource::kLevel);
  EXPECT_EQ(frame.calibration.color.camera.fy, 51.0);
  EXPECT_EQ(frame.calibration.depth_scale_m, 0.0005);
  EXPECT_EQ(cv::norm(frame.images.depth, depth_ramp(), cv::NORM_INF), 0.0);
}

TEST_F(DepthCameraProgram, EndsWithCode2OnInputThatCannotBeUsed) {
  EXPECT_THAT(error({"--source", "/nowhere"}), HasSubstr("/nowhere: does not exist"));
  EXPECT_THAT(error({"--source", "/dev/video0"}), HasSubstr("--source-depth"));
  testing::write_bytes(folder_ + "/a_depth.png",
                       encode_png(cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(9))));
  EXPECT_THAT(error({"--source", folder_}), HasSubstr("one of 16 bit is needed"));
  testing::write_bytes(folder_ + "/a_depth.png",
                       encode_png(cv::Mat(10, 10, CV_16UC1, cv::Scalar(9))));
  EXPECT_THAT(error({"--source", folder_}),
              HasSubstr("the color image is 64x48, the depth one 10x10"));
  std::filesystem::remove(folder_ + "/a_depth.png");
  EXPECT_THAT(error({"--source", folder_}), HasSubstr("has no partner a_depth"));
}

TEST_F(DepthCameraProgram, WritesALogOfTheRealRecording) {
  const std::string data = LIMBCAST_DATA_DIR;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";
  const std::string source = data + "/rgbd_pointing";
  const RunResult result =
      write_log({"--source", source, "--calibration", source + "/calibration.yml"});
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("60 frames sent"));
}

}  // namespace
}  // namespace limbcast::test
