#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/module_status_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>

#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "common/sources/capture_time.hpp"
#include "tests/stereo_camera/recorded_pairs.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/piped_camera.hpp"

namespace limbcast::test {
namespace {

using lcm_io::decode;
using lcm_io::Keep;
using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kWrongInput = 2;
/// How often a wait looks whether the program ended.
constexpr milliseconds kLook{100};

class StereoCameraProgram : public ::testing::Test {
 protected:
  std::vector<std::string> command(const std::vector<std::string>& options) const {
    std::vector<std::string> words = {program("limbcast-stereo-camera")};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }
  RunResult write_log(const std::vector<std::string>& options) const {
    std::vector<std::string> all = {"--calibration", calibration_, "--log", log_};
    all.insert(all.end(), options.begin(), options.end());
    return run(command(all));
  }
  std::string folder_ = temporary_folder("pairs");
  std::string calibration_ = write_stereo_calibration(folder_);
  std::string log_ = temporary_folder("log") + "/in.log";
};

TEST_F(StereoCameraProgram, WritesALogThatExplainsItself) {
  write_pairs(folder_, 4, 400'000);
  write_text(folder_ + "/frame_1_gt.json", R"({"utime": 1000400000, "persons": []})");

  const RunResult result = write_log({"--source", folder_});

  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto events = events_of(log_);
  // The calibration comes first, then once a second: at 0.0 and, as 1.0 s has no frame, 1.2 s.
  ASSERT_THAT(channels_of(events),
              ElementsAre("STEREO_CALIBRATION", "STEREO_IMAGES", "STEREO_IMAGES", "GROUND_TRUTH",
                          "STEREO_IMAGES", "STEREO_CALIBRATION", "STEREO_IMAGES"));
  EXPECT_EQ(events[2].utime, 1'000'400'000);
  const auto images = decode<stereo_images_t>(events[2].data);
  EXPECT_EQ(images.stamp.utime, 1'000'400'000);
  EXPECT_EQ(images.stamp.sequence, 1);
  EXPECT_EQ(images.left.data, read_encoded_image(folder_ + "/frame_1_left.jpg").bytes);
  EXPECT_EQ(images.right.data, read_encoded_image(folder_ + "/frame_1_right.jpg").bytes);
  EXPECT_EQ(decode<body_poses_t>(events[3].data).stamp.utime, 1'000'400'000);
  EXPECT_EQ(decode<stereo_calibration_t>(events[0].data).T[0], -0.12);
}

TEST_F(StereoCameraProgram, WritesTheSameLogAgain) {
  write_pairs(folder_, 3, 100'000);
  ASSERT_EQ(write_log({"--source", folder_}).exit_code, 0);
  const auto first = events_of(log_);
  ASSERT_EQ(write_log({"--source", folder_}).exit_code, 0);
  const auto second = events_of(log_);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].data, second[i].data);
}

TEST_F(StereoCameraProgram, RenamesSensorAndChannels) {
  write_pairs(folder_, 1, 100'000);
  const RunResult result = write_log({"--source", folder_, "--sensor", "rear", "--images-channel",
                                      "REAR_IMAGES", "--calibration-channel", "REAR_CALIBRATION"});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto events = events_of(log_);
  ASSERT_THAT(channels_of(events), ElementsAre("REAR_CALIBRATION", "REAR_IMAGES"));
  EXPECT_EQ(decode<stereo_images_t>(events[1].data).stamp.frame, "rear/left_rectified");
}

TEST_F(StereoCameraProgram, TakesGravityFromTheOption) {
  write_pairs(folder_, 1, 100'000);
  ASSERT_EQ(
      write_log({"--source", folder_, "--down", "0,0.6,0.8", "--sensor-height-m", "1.5"}).exit_code,
      0);
  const auto stamp = decode<stereo_images_t>(events_of(log_)[1].data).stamp;
  EXPECT_EQ(stamp.gravity_source, static_cast<int>(GravitySource::kOption));
  EXPECT_FLOAT_EQ(stamp.down[2], 0.8F);
  EXPECT_FLOAT_EQ(stamp.sensor_height_m, 1.5F);
}

TEST_F(StereoCameraProgram, EndsWithCode2OnInputThatCannotBeUsed) {
  const auto error = [this](const std::vector<std::string>& options) {
    const RunResult result = write_log(options);
    EXPECT_EQ(result.exit_code, kWrongInput) << result.output;
    return result.output;
  };
  EXPECT_THAT(error({"--source", "/nowhere"}), HasSubstr("/nowhere: does not exist"));
  EXPECT_THAT(error({"--source", folder_}), HasSubstr("has no NAME_left and NAME_right pictures"));
  EXPECT_THAT(error({}), HasSubstr("--source is missing"));
  EXPECT_THAT(error({"--source", "/dev/video987"}), HasSubstr("is the camera plugged in?"));
  write_pairs(folder_, 2, 100'000);
  EXPECT_THAT(error({"--source", folder_, "--loop"}), HasSubstr("never end"));
  EXPECT_THAT(error({"--source", folder_, "--down", "0,9.81,0"}),
              HasSubstr("must be a unit vector"));
  EXPECT_THAT(error({"--source", folder_, "--calibration", folder_ + "/none.yml"}),
              HasSubstr("none.yml: cannot be read"));
  EXPECT_THAT(
      error({"--source", folder_, "--calibration", write_stereo_calibration(folder_, -0.12)}),
      HasSubstr("swap the left and right cameras"));
  write_stereo_calibration(folder_);
  std::filesystem::resize_file(folder_ + "/frame_1_right.jpg", 100);
  EXPECT_THAT(error({"--source", folder_}), HasSubstr("frame_1_right.jpg: is a torn JPEG"));
  std::filesystem::remove(folder_ + "/frame_1_right.jpg");
  EXPECT_THAT(error({"--source", folder_}), HasSubstr("has no partner frame_1_right"));
}

/// The program publishing on LCM, and what a listener hears.
class PublishingStereoCamera : public StereoCameraProgram {
 protected:
  PublishingStereoCamera() {
    bus_.subscribe<stereo_images_t>(
        "STEREO_IMAGES", Keep::kAll,
        [this](const stereo_images_t& message) { images_.push_back(message); });
    bus_.subscribe<stereo_calibration_t>("STEREO_CALIBRATION", Keep::kAll,
                                         [this](const stereo_calibration_t&) { ++calibrations_; });
    bus_.subscribe<module_status_t>("MODULE_STATUS", Keep::kAll,
                                    [this](const module_status_t& message) {
                                      status_ = message;
                                      ++statuses_;
                                    });
  }
  void start(const std::vector<std::string>& options) {
    std::vector<std::string> all = {"--calibration", calibration_, "--lcm-url", url_};
    all.insert(all.end(), options.begin(), options.end());
    camera_.emplace(command(all), folder_ + "/output.txt");
  }
  /// Fails when the program ends, or says again and again how it is without anything else coming.
  template <class Done>
  ::testing::AssertionResult wait_for(Done done) {
    constexpr int kStatusesInVain = 60;
    const int last_status = statuses_ + kStatusesInVain;
    while (!done()) {
      bus_.handle(kLook);
      if (!done() && (!camera_->running() || statuses_ > last_status)) {
        return ::testing::AssertionFailure()
               << (camera_->running() ? "in vain: " : "ended: ") << camera_->output();
      }
    }
    return ::testing::AssertionSuccess();
  }
  int stop() {
    camera_->signal(SIGTERM);
    return camera_->wait();
  }

  std::string url_ = private_lcm_url();
  lcm_io::Bus bus_{url_};
  std::vector<stereo_images_t> images_;
  int calibrations_ = 0, statuses_ = 0;
  std::optional<module_status_t> status_;
  std::optional<ChildProcess> camera_;
};

TEST_F(PublishingStereoCamera, LoopsThroughARecordingUntilItIsToldToEnd) {
  write_pairs(folder_, 3, 100'000);
  start({"--source", folder_, "--loop", "--rate", "100"});

  ASSERT_TRUE(wait_for([this] { return images_.size() >= 8 && status_; }));

  EXPECT_EQ(stop(), 0);
  EXPECT_GE(calibrations_, 1);
  EXPECT_EQ(status_->module, "stereo_camera");
  EXPECT_EQ(status_->state, "running");
  for (std::size_t i = 1; i < images_.size(); ++i) {
    EXPECT_GT(images_[i].stamp.utime, images_[i - 1].stamp.utime);
    EXPECT_GT(images_[i].stamp.sequence, images_[i - 1].stamp.sequence);
  }
}

TEST_F(PublishingStereoCamera, StampsWithTheMomentOfSendingWhereAskedTo) {
  write_pairs(folder_, 3, 100'000);
  start({"--source", folder_, "--loop", "--rate", "100", "--restamp"});
  ASSERT_TRUE(wait_for([this] { return status_ && !images_.empty(); }));
  EXPECT_EQ(stop(), 0);
  // The recording says 1000 s after 1970.
  EXPECT_GT(images_.front().stamp.utime, 1'000'000'000'000'000);
}

TEST_F(PublishingStereoCamera, RepeatsTheCalibrationOfALogForModulesThatStartLater) {
  write_pairs(folder_, 4, 100'000);
  ASSERT_EQ(write_log({"--source", folder_}).exit_code, 0);
  // The log has a calibration at its begin, and lasts two seconds at this rate.
  start({"--source", log_, "--rate", "2"});
  EXPECT_EQ(camera_->wait(), 0) << camera_->output();
  while (bus_.handle(kLook)) continue;
  EXPECT_GE(calibrations_, 2);
}

TEST_F(PublishingStereoCamera, EndsByItselfWithARecording) {
  write_pairs(folder_, 3, 1'000);
  start({"--source", folder_});
  EXPECT_EQ(camera_->wait(), 0);
  EXPECT_THAT(camera_->output(), HasSubstr("3 frames sent"));
}

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
  EXPECT_THAT(camera_->output(), HasSubstr("/dev/video987: cannot be started"));
}

TEST_F(TwoLiveCameras, TakeNoSettingsThatOnlyADriverCanDo) {
  start({"--source", camera("left"), "--source-right", camera("right"), "--exposure", "20",
         "--gain", "3"});
  EXPECT_EQ(camera_->wait(), kWrongInput);
  EXPECT_THAT(camera_->output(), HasSubstr("exposure, gain can be set for /dev/videoN only"));
}

TEST_F(StereoCameraProgram, WritesLogsOfTheRecordings) {
  const std::string data = LIMBCAST_DATA_DIR;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";
  for (const char* name : {"multi", "distorted", "hd"}) {
    const std::string source = data + "/stereo_dev/" + name;
    const RunResult result =
        write_log({"--source", source, "--calibration", source + "/calibration.yml"});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("12 frames sent"));
  }
}

}  // namespace
}  // namespace limbcast::test
