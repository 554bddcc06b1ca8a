#include "common/sources/live_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "common/input_error.hpp"
#include "tests/common/sources/played_camera.hpp"
#include "tests/common/sources/test_pictures.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

using std::chrono::milliseconds;
using test::depth_format;
using test::error_of;
using test::grey_picture;
using test::level_of;
using test::PlayedCamera;
using test::stereo_format;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Long enough for any thread to be scheduled; a test that waits so long has failed.
constexpr milliseconds kForEver{20000};

CapturedFrame frame_at(std::int64_t utime) { return {utime, grey_picture(64, 48, 9)}; }

LiveCaptureParams params_of(const std::string& name, bool reopen) {
  LiveCaptureParams params;
  params.name = name;
  params.reopen = reopen;
  params.reopen_interval = milliseconds(1);
  return params;
}

TEST(LiveCaptureTest, DropsTheOldestWhereNobodyTakes) {
  PlayedCamera camera;
  for (std::int64_t utime = 0; utime < 10; ++utime) camera.push(frame_at(utime));
  camera.end();
  LiveCapture capture(camera.opener(), params_of("cam", false));
  while (capture.statistics().captured < 10) std::this_thread::yield();

  std::vector<std::int64_t> utimes;
  for (const CapturedFrame& frame : capture.take(kForEver)) utimes.push_back(frame.utime);

  EXPECT_THAT(utimes, ElementsAre(7, 8, 9));
  EXPECT_EQ(capture.statistics().dropped, 7);
}

TEST(LiveCaptureTest, EndsWithTheStreamWhereItIsNotToBeOpenedAgain) {
  PlayedCamera camera;
  camera.push(frame_at(1));
  camera.end();
  LiveCapture capture(camera.opener(), params_of("cam", false));
  EXPECT_EQ(capture.take(kForEver).size(), 1U);
  EXPECT_TRUE(capture.take(kForEver).empty());
  EXPECT_TRUE(capture.ended());
  EXPECT_THAT(capture.statistics().problem, HasSubstr("cam: gives no frames any more"));
}

TEST(LiveCaptureTest, TellsWhyACameraFailed) {
  struct Failing : FrameReader {
    std::optional<CapturedFrame> read() override { throw InputError("cam: its cable is loose"); }
  };
  LiveCapture capture([] { return std::make_unique<Failing>(); }, params_of("cam", false));
  EXPECT_TRUE(capture.take(kForEver).empty());
  EXPECT_TRUE(capture.ended());
  EXPECT_EQ(capture.statistics().problem, "cam: its cable is loose");
}

TEST(LiveCaptureTest, OpensACameraAgainThatWasUnplugged) {
  PlayedCamera camera;
  const auto openings = std::make_shared<std::atomic<int>>(0);
  const OpenReader gone_for_two_attempts = [opener = camera.opener(), openings] {
    const int opening = ++*openings;
    if (opening == 2 || opening == 3) throw InputError("cam: no such device");
    return opener();
  };
  LiveCapture capture(gone_for_two_attempts, params_of("cam", true));
  camera.push(frame_at(1));
  EXPECT_EQ(capture.take(kForEver).size(), 1U);
  camera.end();
  camera.push(frame_at(2));

  const auto frames = capture.take(kForEver);

  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].utime, 2);
  EXPECT_EQ(capture.statistics().reopened, 1);
  EXPECT_EQ(capture.statistics().problem, "");
  EXPECT_EQ(*openings, 4);
}

TEST(LiveCaptureTest, TellsThatACameraStalled) {
  const PlayedCamera camera;
  LiveCaptureParams params = params_of("cam", true);
  params.stall_timeout = milliseconds(0);
  const LiveCapture capture(camera.opener(), params);
  EXPECT_THAT(capture.statistics().problem, HasSubstr("cam: stalled, no frame for 0 ms"));
}

TEST(LiveCaptureTest, FailsAtOnceWhereTheCameraIsMissing) {
  const OpenReader missing = []() -> std::unique_ptr<FrameReader> {
    throw InputError("/dev/video9: No such file or directory");
  };
  EXPECT_THAT(error_of<InputError>([&] { LiveCapture(missing, params_of("cam", true)); }),
              HasSubstr("/dev/video9: No such file"));
}

TEST(LiveCaptureTest, LeavesACameraBehindThatHangs) {
  const auto hanging = std::make_shared<std::mutex>();
  std::unique_lock hold(*hanging);
  const OpenReader open = [hanging]() -> std::unique_ptr<FrameReader> {
    const std::lock_guard lock(*hanging);
    throw InputError("cam: late");
  };
  LiveCaptureParams params = params_of("cam", false);
  params.open_timeout = milliseconds(1);
  EXPECT_THAT(error_of<InputError>([&] { LiveCapture(open, params); }),
              HasSubstr("cam: did not open in time"));
}

TEST(LiveCaptureTest, HasItsProblemUntilAFrameComesAgain) {
  PlayedCamera camera;
  camera.end();
  LiveCapture capture(camera.opener(), params_of("cam", true));
  while (capture.statistics().reopened < 1) std::this_thread::yield();
  EXPECT_THAT(capture.statistics().problem, HasSubstr("cam: gives no frames any more"));
  camera.push(frame_at(1));
  ASSERT_EQ(capture.take(kForEver).size(), 1U);
  EXPECT_EQ(capture.statistics().problem, "");
}

std::optional<FramePair> wait_for_frame(PairSource& source) {
  std::optional<FramePair> frame;
  while (!frame && !source.ended()) frame = source.next();
  return frame;
}

TEST(SideBySideSourceTest, SplitsThePicture) {
  PlayedCamera camera;
  cv::Mat both(48, 128, CV_8UC3, cv::Scalar::all(200));
  both.colRange(0, 64).setTo(cv::Scalar::all(50));
  camera.push({123, both});
  camera.end();
  SideBySideSource source(camera.opener(), params_of("cam", false), stereo_format());

  const auto frame = wait_for_frame(source);

  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp.utime, 123);
  EXPECT_NEAR(level_of(frame->first), 50, 1);
  EXPECT_NEAR(level_of(frame->second), 200, 1);
}

/// A picture that the camera coded itself.
CapturedFrame coded_frame_at(std::int64_t utime, const cv::Mat& pixels) {
  CapturedFrame frame{utime, {}};
  frame.picture.jpeg = encode_jpeg(pixels, 90);
  return frame;
}

TEST(SideBySideSourceTest, SplitsAJpegOfTheCamera) {
  PlayedCamera camera;
  cv::Mat both(48, 128, CV_8UC3, cv::Scalar::all(200));
  both.colRange(0, 64).setTo(cv::Scalar::all(50));
  camera.push(coded_frame_at(123, both));
  camera.end();
  SideBySideSource source(camera.opener(), params_of("cam", false), stereo_format());

  const auto frame = wait_for_frame(source);

  ASSERT_TRUE(frame);
  EXPECT_NEAR(level_of(frame->first), 50, 1);
  EXPECT_NEAR(level_of(frame->second), 200, 1);
}

TEST(SideBySideSourceTest, RefusesPicturesOfTheWrongSize) {
  PlayedCamera camera;
  camera.push({1, grey_picture(100, 48, 1)});
  SideBySideSource source(camera.opener(), params_of("cam", false), stereo_format());
  EXPECT_THAT(error_of<InputError>([&] { wait_for_frame(source); }),
              HasSubstr("cam: the left image is 50x48, the calibration is for 64x48"));
}

TEST(SideBySideSourceTest, WaitsForFittingPicturesWhereTheCameraComesBackWithOthers) {
  PlayedCamera camera;
  SideBySideSource source(camera.opener(), params_of("cam", true), stereo_format());
  camera.push({1, grey_picture(128, 48, 1)});
  ASSERT_TRUE(wait_for_frame(source));

  camera.end();
  camera.push({2, grey_picture(100, 48, 1)});
  const auto misfits = [&] {
    return source.problem().find("the left image is 50x48") != std::string::npos;
  };
  while (!misfits()) ASSERT_FALSE(source.next());
  EXPECT_EQ(source.statistics()->dropped, 1);

  camera.push({3, grey_picture(128, 48, 1)});
  const auto frame = wait_for_frame(source);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp.utime, 3);
  EXPECT_EQ(source.problem(), "");
}

TEST(SideBySideSourceTest, RefusesPicturesOfOddWidth) {
  PlayedCamera camera;
  camera.push({1, grey_picture(101, 48, 1)});
  SideBySideSource source(camera.opener(), params_of("cam", false), stereo_format());
  EXPECT_THAT(error_of<InputError>([&] { wait_for_frame(source); }),
              HasSubstr("width 101 do not hold two cameras"));
}

PairFormat depth_alone_format() {
  PairFormat format = depth_format();
  format.first_is_optional = true;
  return format;
}

TEST(DepthAloneSourceTest, GivesEveryDepthValueWithoutColour) {
  PlayedCamera camera;
  const cv::Mat depth(48, 64, CV_16UC1, cv::Scalar(40'000));
  camera.push({123, {depth}});
  DepthAloneSource source(camera.opener(), params_of("cam", false), depth_alone_format());

  const auto frame = wait_for_frame(source);

  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp.utime, 123);
  EXPECT_TRUE(frame->first.empty());
  EXPECT_EQ(cv::norm(decode_image(frame->second, "test"), depth, cv::NORM_INF), 0.0);
}

TEST(DepthAloneSourceTest, RefusesWhatIsNoDepthOfTheCalibratedSize) {
  const auto error_with = [](const cv::Mat& pixels) {
    PlayedCamera camera;
    camera.push({1, {pixels}});
    DepthAloneSource source(camera.opener(), params_of("cam", false), depth_alone_format());
    return error_of<InputError>([&] { wait_for_frame(source); });
  };
  EXPECT_THAT(error_with(cv::Mat(24, 32, CV_16UC1, cv::Scalar(1))),
              HasSubstr("cam: the depth image is 32x24, the calibration is for 64x48"));
  EXPECT_THAT(error_with(grey_picture(64, 48, 1)), HasSubstr("one of 16 bit is needed"));
}

class TwoCameras : public ::testing::Test {
 protected:
  TwoCameraSource open() const {
    return {left_.opener(),  params_of("left", false),
            right_.opener(), params_of("right", false),
            stereo_format(), 10'000};
  }
  PlayedCamera left_, right_;
};

TEST_F(TwoCameras, ArePairedByTime) {
  left_.push({10'000, grey_picture(64, 48, 50)});
  right_.push({14'000, grey_picture(64, 48, 200)});
  TwoCameraSource source = open();

  const auto frame = wait_for_frame(source);

  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp.utime, 12'000);
  EXPECT_NEAR(level_of(frame->first), 50, 1);
  EXPECT_NEAR(level_of(frame->second), 200, 1);
}

TEST_F(TwoCameras, HaveTheirJpegsSentByteByByte) {
  const CapturedFrame left = coded_frame_at(0, grey_picture(64, 48, 50));
  const CapturedFrame right = coded_frame_at(0, grey_picture(64, 48, 200));
  left_.push(left);
  right_.push(right);
  TwoCameraSource source = open();

  const auto frame = wait_for_frame(source);

  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->first.bytes, left.picture.jpeg->bytes);
  EXPECT_EQ(frame->second.bytes, right.picture.jpeg->bytes);
}

TEST_F(TwoCameras, HaveFramesWithoutPartnerCounted) {
  left_.push(frame_at(0));
  left_.push(frame_at(100'000));
  right_.push(frame_at(101'000));
  TwoCameraSource source = open();
  ASSERT_TRUE(wait_for_frame(source));
  EXPECT_EQ(source.statistics()->unpaired, 1);
}

TEST_F(TwoCameras, OfDifferentSizeAreRefused) {
  left_.push(frame_at(0));
  right_.push({0, grey_picture(32, 48, 1)});
  TwoCameraSource source = open();
  EXPECT_THAT(error_of<InputError>([&] { wait_for_frame(source); }),
              HasSubstr("left and right: the left image is 64x48, the right one 32x48"));
}

TEST_F(TwoCameras, EndWhereOneEnds) {
  right_.end();
  TwoCameraSource source = open();
  EXPECT_FALSE(wait_for_frame(source));
  EXPECT_THAT(source.problem(), HasSubstr("right: gives no frames any more"));
}

TEST(Mounting, OfTheOptionWinsOverRecordingOverCalibration) {
  const Mounting none;
  Mounting option;
  option.down = Eigen::Vector3d(0.0, 0.0, 1.0);
  Mounting calibration;
  calibration.down = Eigen::Vector3d(1.0, 0.0, 0.0);
  calibration.sensor_height_m = 1.5;

  Gravity recorded;
  recorded.source = GravitySource::kRecording;
  apply_mounting(none, calibration, recorded);
  EXPECT_EQ(recorded.source, GravitySource::kRecording);
  EXPECT_EQ(recorded.down, Eigen::Vector3f::UnitY());
  EXPECT_EQ(recorded.sensor_height_m, 1.5F);
  apply_mounting(option, calibration, recorded);
  EXPECT_EQ(recorded.source, GravitySource::kOption);
  EXPECT_EQ(recorded.down, Eigen::Vector3f::UnitZ());

  Gravity unknown;
  apply_mounting(none, calibration, unknown);
  EXPECT_EQ(unknown.down, Eigen::Vector3f::UnitX());
  EXPECT_EQ(unknown.source, GravitySource::kOption);

  Gravity level;
  apply_mounting(none, none, level);
  EXPECT_EQ(level.source, GravitySource::kLevel);
}

}  // namespace
}  // namespace limbcast
