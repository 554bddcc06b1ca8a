#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "common/sources/capture_time.hpp"
#include "tests/stereo_camera/stereo_camera_program.hpp"
#include "tests/support/piped_camera.hpp"

namespace limbcast::test {
namespace {

using lcm_io::decode;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(StereoCameraProgram, PlaysRecordedPairsThroughAPipelineAtTheirRate) {
  if (!has_gstreamer()) GTEST_SKIP() << "gstreamer1.0-plugins-base and -good are absent";
  constexpr int kFrames = 10;
  constexpr std::int64_t kPeriod_us = 100'000;
  write_pairs(folder_, kFrames, kPeriod_us);
  const auto camera = [this](const std::string& side) {
    return "multifilesrc location=" + folder_ + "/frame_%d_" + side +
           ".jpg stop-index=9 caps=image/jpeg,framerate=10/1 ! jpegdec ! both.sink_" +
           (side == "left" ? "0 " : "1 ");
  };
  const std::string pipeline = camera("left") + camera("right") +
                               "compositor name=both sink_1::xpos=64 ! identity sync=true";

  const std::int64_t started_utime = read_clocks().utime;
  const RunResult result = write_log({"--source", "gst:" + pipeline, "--reopen=false"});

  ASSERT_EQ(result.exit_code, 0) << result.output;
  std::vector<StereoImages> pairs;
  for (const auto& event : events_of(log_)) {
    if (event.channel != "STEREO_IMAGES") continue;
    pairs.push_back(lcm_io::from_message(decode<stereo_images_t>(event.data)));
  }
  // A busy computer may drop frames or read them late, but the last one always comes, and none
  // before its time.
  ASSERT_GE(pairs.size(), 2U);
  EXPECT_LE(pairs.size(), static_cast<std::size_t>(kFrames));
  std::int64_t last_utime = started_utime;
  for (const StereoImages& pair : pairs) {
    const int left = pair.left.at<cv::Vec3b>(24, 32)[0];
    const int right = pair.right.at<cv::Vec3b>(24, 32)[0];
    EXPECT_NEAR(right - left, kRightLighter, 4);
    const auto frame = std::lround((left - kFirstLevel) / static_cast<double>(kLevelStep));
    EXPECT_GE(pair.stamp.utime - started_utime, frame * kPeriod_us) << "frame " << frame;
    EXPECT_GT(pair.stamp.utime, last_utime);
    last_utime = pair.stamp.utime;
  }
  EXPECT_NEAR(pairs.back().left.at<cv::Vec3b>(24, 32)[0], kFirstLevel + kLevelStep * (kFrames - 1),
              2);
}

/// A camera whose frames the test gives, both pictures side by side.
class CameraThatStalls : public PublishingStereoCamera {
 protected:
  void SetUp() override {
    if (!has_gstreamer()) GTEST_SKIP() << "gstreamer1.0-plugins-base and -good are absent";
    live_.emplace(folder_ + "/camera", kBoth.size());
    start({"--source", live_->source(), "--reopen=" + std::string(reopens() ? "true" : "false")});
  }
  virtual bool reopens() const { return false; }
  void give_picture() { ASSERT_TRUE(live_->give(kBoth, *camera_)) << camera_->output(); }

  const cv::Mat kBoth{kHeight, 2 * kWidth, CV_8UC1, cv::Scalar(99)};
  std::optional<PipedCamera> live_;
};

TEST_F(CameraThatStalls, IsToldInTheStatusAndGoesOn) {
  give_picture();
  give_picture();
  ASSERT_TRUE(wait_for([this] { return !images_.empty(); }));

  ASSERT_TRUE(wait_for([this] { return status_ && status_->state == "failing"; }));
  EXPECT_THAT(status_->last_error, HasSubstr("stalled, no frame for 2000 ms"));

  const std::size_t before = images_.size();
  ASSERT_TRUE(wait_for([&] {
    give_picture();
    return images_.size() > before;
  }));
  EXPECT_EQ(stop(), 0) << camera_->output();
}

TEST_F(CameraThatStalls, DoesNotKeepTheProgramFromEnding) {
  give_picture();
  give_picture();
  ASSERT_TRUE(wait_for([this] { return status_ && status_->state == "failing"; }));
  EXPECT_EQ(stop(), 0) << camera_->output();
}

TEST_F(CameraThatStalls, EndsTheProgramWithTheStream) {
  give_picture();
  give_picture();
  ASSERT_TRUE(wait_for([this] { return !images_.empty(); }));
  live_->unplug();
  EXPECT_EQ(camera_->wait(), 0) << camera_->output();
  EXPECT_THAT(camera_->output(), HasSubstr("gives no frames any more"));
}

class CameraThatIsUnplugged : public CameraThatStalls {
 protected:
  bool reopens() const override { return true; }
};

TEST_F(CameraThatIsUnplugged, IsOpenedAgainWhenItComesBack) {
  give_picture();
  give_picture();
  ASSERT_TRUE(wait_for([this] { return !images_.empty(); }));
  live_->unplug();
  ASSERT_TRUE(wait_for([this] { return status_ && status_->state == "failing"; }));
  EXPECT_THAT(status_->last_error, HasSubstr("gives no frames any more (unplugged or ended)"));

  live_->plug_in();
  const std::size_t before = images_.size();
  // It must be fed on, or it is told to stall.
  ASSERT_TRUE(wait_for([&] {
    give_picture();
    return images_.size() > before && status_->state == "running";
  }));
  EXPECT_THAT(status_->note, HasSubstr("1 reopened"));
  EXPECT_GT(images_.back().stamp.sequence, images_.front().stamp.sequence);
  EXPECT_EQ(stop(), 0) << camera_->output();
  EXPECT_THAT(camera_->output(), HasSubstr("over: "));
}

/// One that breaks after some pictures, again and again.
class CameraThatBreaks : public PublishingStereoCamera {
 protected:
  void SetUp() override {
    if (!has_gstreamer()) GTEST_SKIP() << "gstreamer1.0-plugins-base and -good are absent";
    start({"--source",
           "gst:videotestsrc is-live=true pattern=white ! video/x-raw,width=128,height=48 ! "
           "identity error-after=4"});
  }
};

TEST_F(CameraThatBreaks, IsToldInGStreamersWordsAndOpenedAgain) {
  ASSERT_TRUE(wait_for([this] { return status_ && status_->state == "failing"; }));
  EXPECT_THAT(status_->last_error,
              HasSubstr("error-after=4: identity0: Failed after iterations as requested."));
  ASSERT_TRUE(wait_for([this] {
    return !images_.empty() && status_->note.find(", 0 reopened") == std::string::npos;
  }));
  EXPECT_EQ(stop(), 0) << camera_->output();
}

/// A pipeline that cannot play. The program ends before it says anything else.
class CameraPipelineThatFails : public StereoCameraProgram {
 protected:
  void SetUp() override {
    if (!has_gstreamer()) GTEST_SKIP() << "gstreamer1.0-plugins-base and -good are absent";
  }
  /// What follows the pipeline's name.
  std::string reason(const std::string& pipeline, bool reopen = true) const {
    const RunResult result = write_log(
        {"--source", "gst:" + pipeline, "--reopen=" + std::string(reopen ? "true" : "false")});
    EXPECT_EQ(result.exit_code, kWrongInput) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
    const std::string name = "limbcast-stereo-camera: gst:" + pipeline + ": ";
    EXPECT_THAT(result.output, StartsWith(name));
    return result.output.substr(std::min(name.size(), result.output.size()));
  }
};

TEST_F(CameraPipelineThatFails, NamesTheElementThatIsMissingAndThePackages) {
  EXPECT_THAT(reason("nonsense"), AllOf(StartsWith("no element \"nonsense\";"),
                                        HasSubstr("gstreamer1.0-plugins-base, -good")));
}

TEST_F(CameraPipelineThatFails, NamesWhatIsWrittenWrong) {
  EXPECT_THAT(reason("videotestsrc ! ! identity"), StartsWith("syntax error;"));
  EXPECT_THAT(reason("videotestsrc colour=red"),
              StartsWith("no property \"colour\" in element \"videotestsrc\"; try it with gst-l"));
  EXPECT_THAT(reason("videotestsrc ! video/x-raw,width=128 ! jpegdec"),
              StartsWith("could not link videotestsrc0 to jpegdec0, jpegdec0 can't handle caps "
                         "video/x-raw, width=(int)128;"));
}

TEST_F(CameraPipelineThatFails, TellsThatNothingGivesPictures) {
  for (const char* sourceless : {"videoconvert", "videoscale ! videoconvert ! appsink", "appsink",
                                 "( decodebin ! videoconvert )"})
    EXPECT_THAT(
        reason(sourceless),
        StartsWith("has no element that pictures come from; begin it with one, as v4l2src"));
}

TEST_F(CameraPipelineThatFails, NamesTheDeviceThatIsMissing) {
  EXPECT_THAT(reason("v4l2src device=/dev/video987 ! image/jpeg ! jpegdec"),
              StartsWith("v4l2src0: Cannot identify device '/dev/video987'. (system error: No such "
                         "file or directory); try it with gst-launch-1.0"));
}

TEST_F(CameraPipelineThatFails, TellsThatItsElementsDoNotAgree) {
  for (const std::string live : {"false", "true"}) {
    EXPECT_THAT(
        reason("videotestsrc is-live=" + live + " ! video/x-raw,format=I420 ! appsink", false),
        StartsWith("videotestsrc0: Internal data stream error. (streaming stopped, reason "
                   "not-negotiated (-4)); try it with gst-launch-1.0"));
  }
}

/// Two cameras, each a pipeline that plays the pictures of one side round and round.
class TwoLiveCameras : public PublishingStereoCamera {
 protected:
  void SetUp() override {
    if (!has_gstreamer()) GTEST_SKIP() << "gstreamer1.0-plugins-base and -good are absent";
    write_pairs(folder_, 10, 100'000);
  }
  std::string camera(const std::string& side) const {
    return "gst:multifilesrc location=" + folder_ + "/frame_%d_" + side +
           ".jpg loop=true stop-index=9 caps=image/jpeg,framerate=10/1 ! jpegdec ! identity "
           "sync=true";
  }
};

TEST_F(TwoLiveCameras, ArePairedByTheMomentOfCapture) {
  // Half a frame: where they began does not matter.
  start(
      {"--source", camera("left"), "--source-right", camera("right"), "--pair-tolerance-ms", "50"});
  ASSERT_TRUE(wait_for([this] { return images_.size() >= 12 && status_; }));
  EXPECT_EQ(stop(), 0) << camera_->output();
  EXPECT_THAT(camera_->output(), HasSubstr("(live, paired by time)"));
  for (const stereo_images_t& message : images_) {
    const StereoImages pair = lcm_io::from_message(message);
    EXPECT_EQ(pair.left.size(), pair.right.size());
  }
  for (std::size_t i = 1; i < images_.size(); ++i)
    EXPECT_GT(images_[i].stamp.utime, images_[i - 1].stamp.utime);
}

TEST_F(TwoLiveCameras, HaveFramesOutOfToleranceDroppedAndCounted) {
  start(
      {"--source", camera("left"), "--source-right", camera("right"), "--pair-tolerance-ms", "0"});
  const auto has_unpaired = [](const module_status_t& status) {
    return status.note.find(" unpaired") != std::string::npos &&
           status.note.find(" 0 unpaired") == std::string::npos;
  };
  ASSERT_TRUE(wait_for([&] { return status_ && has_unpaired(*status_); }));
  EXPECT_EQ(stop(), 0) << camera_->output();
}

TEST_F(TwoLiveCameras, OfOtherSizeThanTheCalibrationEndTheProgram) {
  const std::string wide = "gst:videotestsrc ! video/x-raw,width=80,height=48";
  start({"--source", wide, "--source-right", wide, "--pair-tolerance-ms", "100"});
  EXPECT_EQ(camera_->wait(), kWrongInput);
  EXPECT_THAT(camera_->output(),
              HasSubstr("the left image is 80x48, the calibration is for 64x48"));
}

TEST_F(TwoLiveCameras, WithoutTheSecondEndTheProgram) {
  start({"--source", camera("left"), "--source-right", "gst:v4l2src device=/dev/video987"});
  EXPECT_EQ(camera_->wait(), kWrongInput);
  EXPECT_THAT(camera_->output(), HasSubstr("Cannot identify device '/dev/video987'"));
}

TEST_F(TwoLiveCameras, TakeNoSettingsThatOnlyADriverCanDo) {
  start({"--source", camera("left"), "--source-right", camera("right"), "--exposure", "20",
         "--gain", "3"});
  EXPECT_EQ(camera_->wait(), kWrongInput);
  EXPECT_THAT(camera_->output(), HasSubstr("exposure, gain can be set for /dev/videoN only"));
}

}  // namespace
}  // namespace limbcast::test
