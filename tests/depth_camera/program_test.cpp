#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/depth_images_t.hpp>

#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/depth_images_codec.hpp"
#include "tests/stereo_camera/recorded_pairs.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/piped_camera.hpp"

namespace limbcast::test {
namespace {

using ::testing::AllOf;
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
    test::write_bytes(folder_ + "/a_color.jpg",
                      encode_jpeg(test::grey_picture(kWidth, kHeight, 80), 95));
    test::write_bytes(folder_ + "/a_depth.png", encode_png(depth_ramp()));
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

constexpr const char* kDepthLens =
    "depth_image_width: 32\ndepth_image_height: 24\n"
    "depth_camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 25., 0., 16., 0., 25.5, 12., 0., 0., 1. ]\n"
    "R: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]\n"
    "T: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ -0.04, 0., 0. ]\n";

TEST_F(DepthCameraProgram, RegistersDepthToColorWhereTheCalibrationTellsHow) {
  std::ofstream(calibration_, std::ios::app) << kDepthLens;
  test::write_bytes(folder_ + "/a_depth.png",
                    encode_png(cv::Mat(24, 32, CV_16UC1, cv::Scalar(4000))));  // 2 m

  const RunResult result = write_log({"--source", folder_});

  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto frame = lcm_io::from_message(lcm_io::decode<depth_images_t>(events_of(log_)[0].data));
  ASSERT_EQ(frame.images.depth.size(), cv::Size(kWidth, kHeight));
  EXPECT_EQ(frame.images.depth.at<std::uint16_t>(24, 32), 4000);
  // By 50 px * 0.04 m / 2 m = 1 px to the left: the right border sees nothing.
  EXPECT_EQ(frame.images.depth.at<std::uint16_t>(24, 63), 0);
}

TEST_F(DepthCameraProgram, RegistersDepthToAColorCameraThatIsAway) {
  std::ofstream(calibration_, std::ios::app) << kDepthLens;
  test::write_bytes(folder_ + "/a_depth.png",
                    encode_png(cv::Mat(24, 32, CV_16UC1, cv::Scalar(4000))));
  std::filesystem::remove(folder_ + "/a_color.jpg");

  const RunResult result = write_log({"--source", folder_});

  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto frame = lcm_io::from_message(lcm_io::decode<depth_images_t>(events_of(log_)[0].data));
  EXPECT_TRUE(frame.images.color.empty());
  EXPECT_EQ(frame.images.depth.size(), cv::Size(kWidth, kHeight));
  EXPECT_EQ(frame.images.stamp.frame, "depth/color_optical");
}

TEST_F(DepthCameraProgram, RefusesDepthOfAnotherSizeThanItsCalibrations) {
  std::ofstream(calibration_, std::ios::app) << kDepthLens;
  EXPECT_THAT(error({"--source", folder_}),
              HasSubstr("the depth image is 64x48, the calibration is for 32x24"));
}

TEST_F(DepthCameraProgram, NamesADepthPictureThatCannotBeDecoded) {
  std::ofstream(calibration_, std::ios::app) << kDepthLens;
  EncodedImage damaged = encode_png(cv::Mat(24, 32, CV_16UC1, cv::Scalar(4000)));
  const std::string data = "IDAT";
  const auto at = std::search(damaged.bytes.begin(), damaged.bytes.end(), data.begin(), data.end());
  ASSERT_LT(at, damaged.bytes.end() - 8);
  std::fill_n(at + 4, 4, 0xFF);
  test::write_bytes(folder_ + "/a_depth.png", damaged);
  EXPECT_THAT(error({"--source", folder_}),
              HasSubstr("limbcast-depth-camera: " + folder_ + "/a_depth.png: cannot be decoded"));
}

std::string pipeline(const std::string& format) {
  return "gst:videotestsrc num-buffers=20 is-live=true ! video/x-raw,width=64,height=48,"
         "framerate=20/1" +
         format;
}
const std::string kColorPipeline = pipeline(""), kDepthPipeline = pipeline(",format=GRAY16_LE");

TEST_F(DepthCameraProgram, TakesColorAndDepthFromTwoPipelines) {
  if (!has_gstreamer()) GTEST_SKIP() << "gstreamer1.0-plugins-base and -good are absent";
  const RunResult result = write_log({"--source", kColorPipeline, "--source-depth", kDepthPipeline,
                                      "--pair-tolerance-ms", "40", "--reopen=false"});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto events = events_of(log_);
  ASSERT_FALSE(events.empty());
  const auto frame = lcm_io::from_message(lcm_io::decode<depth_images_t>(events[0].data));
  EXPECT_EQ(frame.images.depth.type(), CV_16UC1);
  double largest = 0.0;
  cv::minMaxLoc(frame.images.depth, nullptr, &largest);
  EXPECT_GT(largest, 255.0);  // white bars: all 16 bits came through
}

TEST_F(DepthCameraProgram, NeedsNoColorCamera) {
  if (!has_gstreamer()) GTEST_SKIP() << "gstreamer1.0-plugins-base and -good are absent";
  const RunResult result = write_log({"--source-depth", kDepthPipeline, "--reopen=false"});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto events = events_of(log_);
  ASSERT_FALSE(events.empty());
  const auto frame = lcm_io::from_message(lcm_io::decode<depth_images_t>(events[0].data));
  EXPECT_TRUE(frame.images.color.empty());
  EXPECT_EQ(frame.images.depth.size(), cv::Size(kWidth, kHeight));
  EXPECT_EQ(frame.images.stamp.frame, "depth/depth_optical");
}

TEST_F(DepthCameraProgram, SendsAFolderWithoutColor) {
  std::filesystem::remove(folder_ + "/a_color.jpg");
  const RunResult result = write_log({"--source", folder_});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto frame = lcm_io::from_message(lcm_io::decode<depth_images_t>(events_of(log_)[0].data));
  EXPECT_TRUE(frame.images.color.empty());
  EXPECT_EQ(cv::norm(frame.images.depth, depth_ramp(), cv::NORM_INF), 0.0);
}

TEST_F(DepthCameraProgram, EndsWithCode2WithoutItsDevices) {
  EXPECT_THAT(error({"--source", "/dev/video987", "--source-depth", "/dev/video986"}),
              HasSubstr("/dev/video987: No such file or directory; is the camera plugged in?"));
  // There is no plug-in, or no device.
  EXPECT_THAT(error({"--source", "gst:openni2src sourcetype=color", "--source-depth",
                     "gst:openni2src sourcetype=depth"}),
              AllOf(HasSubstr("gst:openni2src sourcetype=color: "), HasSubstr("gstreamer1.0-")));
  EXPECT_THAT(error({"--source-depth", "gst:nonsense ! appsink"}),
              HasSubstr("gst:nonsense ! appsink: no element \"nonsense\""));
}

TEST_F(DepthCameraProgram, RefusesOptionsOfCamerasForARecording) {
  EXPECT_THAT(error({"--source", folder_, "--gain", "3"}),
              HasSubstr(": is a recording; leave out gain (for live sensors only)"));
  EXPECT_THAT(error({"--source", folder_, "--source-depth", "/dev/video2"}),
              HasSubstr(": holds all images; leave out source-depth"));
}

TEST_F(DepthCameraProgram, PassesOverOptionsOfCamerasInTheRobotsFileForARecording) {
  const std::string config = folder_ + "/robot.conf";
  std::ofstream(config) << "[depth_camera]\nsource-depth = /dev/video987\ngain = 3\n";
  const RunResult result = write_log({"--config", config, "--source", folder_});
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

TEST_F(DepthCameraProgram, RefusesAStartTimeForWhatHasTimesOfItsOwn) {
  EXPECT_EQ(write_log({"--source", folder_, "--start-time-s", "7"}).exit_code, 0);
  EXPECT_EQ(events_of(log_).at(0).utime, 7'000'000);
  write_text(folder_ + "/timestamps.csv", "frame,utime\na,1000000000\n");
  for (const std::string option : {"--source", "--source-depth"})
    EXPECT_EQ(error({option, "/dev/video987", "--start-time-s", "7"}),
              "limbcast-depth-camera: /dev/video987: tells the times of the frames; leave out "
              "start-time-s\n");
  EXPECT_EQ(error({"--source", folder_, "--start-time-s", "7"}),
            "limbcast-depth-camera: " + folder_ +
                "/timestamps.csv: tells the times of the frames; leave out start-time-s\n");
}

TEST_F(DepthCameraProgram, EndsWithCode2OnInputThatCannotBeUsed) {
  EXPECT_THAT(error({"--source", "/nowhere"}), HasSubstr("/nowhere: does not exist"));
  EXPECT_THAT(error({"--source", "/dev/video0"}), HasSubstr("--source-depth"));
  EXPECT_THAT(error({"--source-depth", folder_}),
              HasSubstr("is no camera; give a folder of depth pictures with --source"));
  test::write_bytes(folder_ + "/a_depth.png",
                    encode_png(cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(9))));
  EXPECT_THAT(error({"--source", folder_}), HasSubstr("one of 16 bit is needed"));
  test::write_bytes(folder_ + "/a_depth.png", encode_png(cv::Mat(10, 10, CV_16UC1, cv::Scalar(9))));
  EXPECT_THAT(error({"--source", folder_}),
              HasSubstr("the color image is 64x48, the depth one 10x10"));
  std::filesystem::remove(folder_ + "/a_depth.png");
  EXPECT_THAT(error({"--source", folder_}), HasSubstr("has no partner a_depth"));
  test::write_bytes(folder_ + "/a_depth.png", encode_png(depth_ramp()));
  std::filesystem::remove(folder_ + "/a_color.jpg");
  test::write_bytes(folder_ + "/a_color.png", encode_png(depth_ramp()));
  EXPECT_THAT(error({"--source", folder_}), HasSubstr("a_color.png: is 16 bit; 8 bit expected"));
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
