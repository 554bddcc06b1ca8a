#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/point_cloud_t.hpp>

#include "common/lcm_io/decode.hpp"
#include "tests/stereo_camera/stereo_camera_program.hpp"

namespace limbcast::test {
namespace {

using lcm_io::decode;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
  EXPECT_THAT(error({"--source", "none.log", "--calibration", ""}),
              HasSubstr("none.log: no such log; check the name"));
  EXPECT_THAT(
      error({"--source", folder_, "--calibration", write_stereo_calibration(folder_, -0.12)}),
      HasSubstr("swap the left and right cameras"));
  EXPECT_THAT(
      error({"--source", folder_, "--calibration", write_stereo_calibration(folder_, 0.12, "0.")}),
      HasSubstr("calibration.yml: 'K1' has its principal point at (0, 24); neither may"));
  write_stereo_calibration(folder_);
  std::filesystem::resize_file(folder_ + "/frame_1_right.jpg", 100);
  EXPECT_THAT(error({"--source", folder_}), HasSubstr("frame_1_right.jpg: is a torn JPEG"));
  std::filesystem::remove(folder_ + "/frame_1_right.jpg");
  EXPECT_THAT(error({"--source", folder_}), HasSubstr("has no partner frame_1_right"));
}

TEST_F(StereoCameraProgram, RefusesOptionsOfCamerasForARecording) {
  write_pairs(folder_, 1, 100'000);
  const std::string log = repository_file("logs/nobody.log");
  for (const std::string& recording : {folder_, log}) {
    const auto error = [&](std::vector<std::string> options) {
      options.insert(options.end(), {"--source", recording, "--calibration", calibration_});
      const RunResult result = run(command(options));
      EXPECT_EQ(result.exit_code, kWrongInput) << result.output;
      return result.output;
    };
    const std::string name = "limbcast-stereo-camera: " + recording;
    EXPECT_EQ(error({"--exposure", "20", "--gain", "3", "--camera-rate", "30"}),
              name +
                  ": is a recording; leave out camera-rate, exposure, gain (for live sensors "
                  "only)\n");
    EXPECT_EQ(error({"--pair-tolerance-ms=10", "--open-timeout-s=5", "--stall-timeout-s=2",
                     "--reopen=false"}),
              name +
                  ": is a recording; leave out pair-tolerance-ms, open-timeout-s, "
                  "stall-timeout-s, reopen (for live sensors only)\n");
    EXPECT_EQ(error({"--source-right", "/dev/video0"}),
              name + ": holds all images; leave out source-right\n");
  }
}

TEST_F(StereoCameraProgram, RefusesAStartTimeForWhatHasTimesOfItsOwn) {
  write_pairs(folder_, 1, 100'000);
  const std::string log = repository_file("logs/nobody.log"), camera = "/dev/video987";
  for (const auto& [source, teller] : {std::pair(folder_, folder_ + "/timestamps.csv"),
                                       std::pair(log, log), std::pair(camera, camera)}) {
    const RunResult result = write_log({"--source", source, "--start-time-s", "7"});
    EXPECT_EQ(result.exit_code, kWrongInput);
    EXPECT_EQ(result.output, "limbcast-stereo-camera: " + teller +
                                 ": tells the times of the frames; leave out start-time-s\n");
  }
}

TEST_F(StereoCameraProgram, TakesAStartTimeOfTheRobotsFileWhereNothingElseTellsTimes) {
  write_pairs(folder_, 1, 100'000);
  write_text(folder_ + "/robot.conf", "[stereo_camera]\nstart-time-s = 7\n");
  const auto start_utime = [this] {
    const RunResult result = write_log({"--source", folder_, "--config", folder_ + "/robot.conf"});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return events_of(log_).at(0).utime;
  };
  EXPECT_EQ(start_utime(), 1'000'000'000);
  std::filesystem::remove(folder_ + "/timestamps.csv");
  EXPECT_EQ(start_utime(), 7'000'000);
}

TEST_F(StereoCameraProgram, PassesOverOptionsOfCamerasInTheRobotsFileForARecording) {
  write_pairs(folder_, 1, 100'000);
  const std::string config = folder_ + "/robot.conf";
  write_text(config,
             "[stereo_camera]\nsource = /dev/video987\nsource-right = /dev/video986\n"
             "camera-width = 640\ncamera-rate = 30\nexposure = 20\ngain = 3\n"
             "pair-tolerance-ms = 5\nopen-timeout-s = 5\nstall-timeout-s = 5\nreopen = false\n");
  const auto play = [&](const std::string& recording, const std::vector<std::string>& more = {}) {
    std::vector<std::string> options = {"--config",      config,       "--source",  recording,
                                        "--calibration", calibration_, "--lcm-url", "memq://"};
    options.insert(options.end(), more.begin(), more.end());
    return run(command(options));
  };
  ASSERT_EQ(write_log({"--source", folder_}).exit_code, 0);
  for (const std::string& recording : {folder_, log_}) {
    const RunResult played = play(recording);
    EXPECT_EQ(played.exit_code, 0) << played.output;
    EXPECT_THAT(played.output, HasSubstr("1 frames sent"));
    EXPECT_THAT(play(recording, {"--gain=3"}).output,
                HasSubstr(": is a recording; leave out gain ("));
    EXPECT_THAT(play(recording, {"--stereo_camera.gain=3"}).output,
                HasSubstr(": is a recording; leave out gain ("));
  }
  const RunResult live = run(command({"--config", config, "--calibration", calibration_}));
  EXPECT_THAT(live.output, HasSubstr("/dev/video987: No such file or directory"));
}

TEST_F(StereoCameraProgram, WritesNoLogOverWhatItReads) {
  write_pairs(folder_, 2, 100'000);
  const std::string times = folder_ + "/timestamps.csv";
  for (const std::string& file : {times, calibration_, folder_ + "/frame_0_left.jpg"}) {
    const auto size = std::filesystem::file_size(file);
    const RunResult result = write_log({"--source", folder_, "--log", file});
    EXPECT_EQ(result.exit_code, kWrongInput);
    EXPECT_THAT(result.output, HasSubstr(file + ": is what is read; choose another --log"));
    EXPECT_EQ(std::filesystem::file_size(file), size);
  }
  const std::string beside = folder_ + "/in.log";
  for (const char* state : {"new", "old"})
    EXPECT_EQ(write_log({"--source", folder_, "--log", beside}).exit_code, 0) << state;
}

TEST_F(StereoCameraProgram, NamesTheChannelsOfALogWithoutPairs) {
  lcm_io::LogWriter log(log_);
  log.write(0, "POINT_CLOUD", point_cloud_t{});
  log.close();
  const RunResult result = run(command({"--source", log_, "--lcm-url", "memq://"}));
  EXPECT_EQ(result.exit_code, kWrongInput);
  EXPECT_THAT(result.output, HasSubstr(log_ + ": holds no frame on STEREO_IMAGES but POINT_CLOUD; "
                                              "choose their channel with --images-channel, or play "
                                              "other messages with lcm-logplayer\n"));
}

TEST_F(StereoCameraProgram, EndsWithCode2OnNamesThatMessagesAndFilesCannotHave) {
  write_pairs(folder_, 1, 100'000);
  for (const char* option : {"--sensor", "--images-channel", "--truth-channel", "--log"}) {
    const RunResult result = write_log({"--source", folder_, option, ""});
    EXPECT_EQ(result.exit_code, kWrongInput) << result.output;
    EXPECT_THAT(result.output, HasSubstr("is '', must be a name"));
  }
}

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
