#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "modules/log/log_info.hpp"
#include "tests/log/logs.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::logs {
namespace {

using ::testing::HasSubstr;

class Info : public ::testing::Test {
 protected:
  const std::string folder_ = test::temporary_folder("log_info");
  const std::string log_ = folder_ + "/in.log";
};

TEST_F(Info, TellsChannelsTypesCountsRatesAndGaps) {
  write_ten_frames(log_);
  const LogInfo info = read_info(log_);
  EXPECT_EQ(info.events, 21);
  EXPECT_NEAR(info.duration_s(), 0.95, 1e-9);
  EXPECT_EQ(info.missing_numbers, 0);
  const ChannelInfo& poses = info.channels.at("BODY_POSES");
  EXPECT_EQ(poses.type, "body_poses_t");
  EXPECT_EQ(poses.messages, 10);
  EXPECT_NEAR(poses.rate_hz(), 10.0, 1e-9);
  EXPECT_EQ(poses.longest_gap_us, kFrame_us);
  EXPECT_TRUE(info.channels.at("FOREIGN").foreign);
  EXPECT_EQ(info.channels.at("FOREIGN").type, "0102030405060708");
}

TEST_F(Info, CallsWhatLcmSendsItselfNotForeign) {
  {
    lcm_io::LogWriter log(log_);
    const std::string words = "lcm self test";
    log.write({kBegin, "LCM_SELF_TEST", {words.begin(), words.end()}, 0});
    log.close();
  }
  const LogInfo info = read_info(log_);
  EXPECT_FALSE(info.channels.at("LCM_SELF_TEST").foreign);
  EXPECT_EQ(info.channels.at("LCM_SELF_TEST").malformed, 0);
  EXPECT_THAT(info_text(info), HasSubstr("LCM's self-test"));
}

TEST_F(Info, CountsLostRepeatedAndRestartedSequenceNumbersOfEachSensor) {
  {
    lcm_io::LogWriter log(log_);
    for (const int number : {0, 1, 4, 4, 5, 0, 1, 3})
      log.write(kBegin, "BODY_POSES", poses_of_frame(number, "front"));
    for (const int number : {7, 8}) log.write(kBegin, "BODY_POSES", poses_of_frame(number, "rear"));
    log.close();
  }
  const LogInfo info = read_info(log_);
  const auto& sensors = info.channels.at("BODY_POSES").sensors;
  EXPECT_EQ(sensors.at("front").frames, 8);
  EXPECT_EQ(sensors.at("front").lost, 3);
  EXPECT_EQ(sensors.at("front").repeated, 1);
  EXPECT_EQ(sensors.at("front").restarts, 1);
  EXPECT_EQ(sensors.at("rear").lost, 0);
}

TEST_F(Info, TellsCamerasAndTheirChanges) {
  {
    lcm_io::LogWriter log(log_);
    log.write(1, "STEREO_CALIBRATION", calibration_of("front"));
    stereo_calibration_t later = calibration_of("front");
    later.utime += 1'000'000;
    log.write(2, "STEREO_CALIBRATION", later);
    log.write(3, "STEREO_CALIBRATION", calibration_of("rear", 0.06));
    log.write(4, "STEREO_CALIBRATION", calibration_of("rear", 0.07));
    log.close();
  }
  const LogInfo info = read_info(log_);
  EXPECT_EQ(info.cameras.at("front").width, 640);
  EXPECT_NEAR(info.cameras.at("front").baseline_m, 0.12, 1e-9);
  EXPECT_EQ(info.cameras.at("front").changes, 0);
  EXPECT_EQ(info.cameras.at("rear").changes, 1);
}

TEST_F(Info, TellsHostsModulesAndMissingEventNumbers) {
  {
    lcm_io::LogWriter log(log_);
    log.write(1, "MODULE_STATUS", status_of("vision", "segmenter"));
    log.write(2, "MODULE_STATUS", status_of("operator", "viewer"));
    log.copy({1, "FOREIGN", {1}, 9});
    log.close();
  }
  const LogInfo info = read_info(log_);
  ASSERT_EQ(info.modules.size(), 2U);
  EXPECT_EQ(info.modules[0].host, "operator");
  EXPECT_EQ(info.modules[1].lost, 3);
  EXPECT_EQ(info.missing_numbers, 7);
  EXPECT_EQ(info.backward_steps, 1);
}

TEST_F(Info, GoesOnBehindMalformedMessagesAndDamage) {
  write_ten_frames(log_);
  std::vector<char> bytes = bytes_of(log_);
  bytes.resize(bytes.size() - 3);
  write_bytes(log_, bytes);
  const LogInfo info = read_info(log_);
  EXPECT_EQ(info.events, 20);
  EXPECT_EQ(info.torn_bytes, 28 + 7 + 9 - 3);
  EXPECT_THAT(info_text(info), HasSubstr("torn"));
}

TEST_F(Info, NamesMessagesThatAreOfTheTypeButTruncated) {
  {
    lcm_io::LogWriter log(log_);
    log.write(1, "BODY_POSES", poses_of_frame(0));
    log.close();
  }
  auto event = events_in(log_).front();
  event.data.resize(event.data.size() - 1);
  {
    lcm_io::LogWriter log(log_);
    log.write(event);
    log.close();
  }
  EXPECT_EQ(read_info(log_).channels.at("BODY_POSES").malformed, 1);
}

TEST_F(Info, PrintsATableOrJson) {
  write_ten_frames(log_);
  const std::string program = test::program("limbcast-log");
  const auto text = test::run({program, "info", log_});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_THAT(text.output, HasSubstr("BODY_POSES"));
  EXPECT_THAT(text.output, HasSubstr("10.00 Hz"));
  EXPECT_THAT(text.output, HasSubstr("baseline 0.1200 m"));
  const auto json = test::run({program, "info", "--json", "--channel", "BODY.*", log_});
  EXPECT_EQ(nlohmann::json::parse(json.output).at("channels").size(), 1U);
  EXPECT_EQ(test::run({program, "info", folder_ + "/none.log"}).exit_code, 2);
}

TEST_F(Info, ReadsTheDemoLog) {
  const LogInfo info = read_info(test::repository_file("logs/multi.log"));
  EXPECT_EQ(info.channels.at("STEREO_IMAGES").type, "stereo_images_t");
  EXPECT_EQ(info.channels.at("STEREO_IMAGES").malformed, 0);
  EXPECT_EQ(info.channels.at("GROUND_TRUTH").messages, info.channels.at("STEREO_IMAGES").messages);
}

}  // namespace
}  // namespace limbcast::logs
