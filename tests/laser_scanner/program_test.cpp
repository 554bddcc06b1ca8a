#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <limbcast/module_status_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <random>

#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "tests/laser_scanner/velodyne_packets.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

constexpr int kWrongInput = 2;

class LaserScannerProgram : public ::testing::Test {
 protected:
  RunResult write_log(const std::vector<std::string>& options) const {
    std::vector<std::string> words = {program("limbcast-laser-scanner"), "--log", log_};
    words.insert(words.end(), options.begin(), options.end());
    return run(words);
  }
  Cloud first_cloud() const { return first_cloud_in(log_); }
  static Cloud first_cloud_in(const std::string& path) {
    lcm_io::LogReader log(path);
    return lcm_io::from_message(lcm_io::decode<point_cloud_t>(log.next()->data));
  }
  std::string folder_ = temporary_folder("clouds");
  std::string log_ = temporary_folder("log") + "/in.log";
};

/// A floor 1.2 m below the scanner (x forward, z up), with points everywhere on it.
void write_floor(const std::string& path) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> ahead(1.0F, 6.0F);
  std::uniform_real_distribution<float> sideways(-3.0F, 3.0F);
  std::ofstream file(path, std::ios::binary);
  for (int i = 0; i < 4000; ++i) {
    const float point[4] = {ahead(random), sideways(random), -1.2F, 0.0F};
    file.write(reinterpret_cast<const char*>(point), sizeof(point));
  }
}

TEST_F(LaserScannerProgram, FindsGravityInTheGround) {
  write_floor(folder_ + "/a.bin");
  const RunResult result = write_log({"--source", folder_, "--sensor", "roof"});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const Cloud cloud = first_cloud();
  EXPECT_EQ(cloud.stamp.frame, "roof/scan");
  EXPECT_FALSE(cloud.organized());
  EXPECT_EQ(cloud.points_m.size(), 4000U);
  EXPECT_EQ(cloud.stamp.gravity.source, GravitySource::kGroundPlane);
  EXPECT_NEAR(cloud.stamp.gravity.down.y(), 1.0F, 1e-3F);
  EXPECT_NEAR(cloud.stamp.gravity.sensor_height_m.value(), 1.2F, 0.01F);
}

TEST_F(LaserScannerProgram, SaysInItsStatusWhoToldGravityAndHowSureTheGroundIs) {
  write_floor(folder_ + "/a.bin");
  const std::string url = private_lcm_url();
  lcm_io::Bus bus(url);
  module_status_t status{};
  bus.subscribe<module_status_t>("MODULE_STATUS", lcm_io::Keep::kAll,
                                 [&status](const module_status_t& message) { status = message; });
  ChildProcess scanner(
      {program("limbcast-laser-scanner"), "--source", folder_, "--loop", "--lcm-url", url},
      folder_ + "/output.txt");
  while (status.num_published == 0 && scanner.running()) bus.handle(std::chrono::milliseconds(50));
  EXPECT_THAT(status.note,
              ContainsRegex("gravity from the ground plane; ground 1.20 m below the sensor, "
                            "confidence (0.[89][0-9]|1.00), 100 % of the points"))
      << scanner.output();
}

TEST_F(LaserScannerProgram, BelievesTheOptionOverTheGround) {
  write_floor(folder_ + "/a.bin");
  ASSERT_EQ(write_log({"--source", folder_, "--down", "0,0.995,0.0998"}).exit_code, 0);
  EXPECT_EQ(first_cloud().stamp.gravity.source, GravitySource::kOption);
}

TEST_F(LaserScannerProgram, EndsWithCode2OnInputThatCannotBeUsed) {
  const auto error = [this](const std::vector<std::string>& options) {
    const RunResult result = write_log(options);
    EXPECT_EQ(result.exit_code, kWrongInput) << result.output;
    return result.output;
  };
  EXPECT_THAT(error({}), HasSubstr("--source is missing"));
  EXPECT_THAT(error({"--source", "/nowhere"}), HasSubstr("/nowhere: does not exist"));
  EXPECT_THAT(error({"--source", repository_file("logs/nobody.log")}),
              HasSubstr("nobody.log: is an LCM log; play its clouds with lcm-logplayer"));
  write_floor(folder_ + "/a.bin");
  EXPECT_THAT(error({"--source", folder_, "--axes", "x,y"}), HasSubstr("'axes' is 'x,y'"));
  EXPECT_THAT(error({"--source", folder_, "--loop"}), HasSubstr("never end"));
  EXPECT_THAT(error({"--source", folder_, "--near-limit-m", "3", "--far-limit-m", "3"}),
              HasSubstr("'near-limit-m' is 3, must be below 'far-limit-m', 3"));
}

TEST_F(LaserScannerProgram, RefusesAStartTimeForWhatHasTimesOfItsOwn) {
  const std::string packets = folder_ + "/a.pcap", timestamps = folder_ + "/timestamps.csv";
  write_floor(folder_ + "/a.bin");
  std::ofstream(packets) << "packets";
  std::ofstream(timestamps) << "name,utime\na,5\n";
  for (const auto& [source, teller] :
       {std::pair(folder_, timestamps), std::pair(packets, packets),
        std::pair(std::string("velodyne:0"), std::string("velodyne:0"))}) {
    const RunResult result = write_log({"--source", source, "--start-time-s", "7"});
    EXPECT_EQ(result.exit_code, kWrongInput);
    EXPECT_EQ(result.output, "limbcast-laser-scanner: " + teller +
                                 ": tells the times of the frames; leave out start-time-s\n");
  }
  EXPECT_EQ(write_log({"--source", folder_ + "/a.bin", "--start-time-s", "7"}).exit_code, 0);
  EXPECT_EQ(first_cloud().stamp.utime, 7'000'000);
}

TEST_F(LaserScannerProgram, RefusesAnOptionOfLiveScannersForARecordingUnlessTheRobotsFileTellsIt) {
  write_floor(folder_ + "/a.bin");
  for (const std::string& recording : {folder_, folder_ + "/a.bin"}) {
    const RunResult result = write_log({"--source", recording, "--stall-timeout-s", "5"});
    EXPECT_EQ(result.exit_code, kWrongInput);
    EXPECT_EQ(result.output,
              "limbcast-laser-scanner: " + recording +
                  ": is a recording; leave out stall-timeout-s (for live sensors only)\n");
  }
  std::ofstream(folder_ + "/robot.conf") << "[laser_scanner]\nstall-timeout-s = 5\n";
  EXPECT_EQ(write_log({"--source", folder_, "--config", folder_ + "/robot.conf"}).exit_code, 0);
}

TEST_F(LaserScannerProgram, TellsOfALogByWhatIsInIt) {
  const auto error = [this](const std::string& name, const std::string& content) {
    const std::string path = folder_ + "/" + name;
    std::ofstream(path, std::ios::binary) << content;
    const RunResult result = write_log({"--source", path});
    EXPECT_EQ(result.exit_code, kWrongInput) << result.output;
    return result.output;
  };
  EXPECT_THAT(error("a.log", ""), HasSubstr("a.log: is empty"));
  EXPECT_THAT(error("a.log", "some words"), HasSubstr("a.log: is neither PCD, PLY nor KITTI .bin"));
  EXPECT_THAT(error("a.bin", "\xED\xA1\xDA\x01"), HasSubstr("a.bin: is an LCM log; play its"));
}

TEST_F(LaserScannerProgram, WarnsOnceOfCloudsWithoutPointsUntilOneHasSome) {
  for (const char* name : {"/a.bin", "/b.bin", "/c.bin"}) write_floor(folder_ + name);
  const std::vector<std::string> far = {"--source", folder_, "--near-limit-m", "20"};
  const RunResult logged = write_log(far);
  const RunResult sent = run({program("limbcast-laser-scanner"), "--source", folder_,
                              "--near-limit-m", "20", "--lcm-url", private_lcm_url()});
  for (const RunResult& result : {logged, sent}) {
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output,
                HasSubstr("a.bin: none of 4000 points lies within 20 to 30 m; give --unit-m"));
    EXPECT_EQ(result.output.find("none of"), result.output.rfind("none of"));
    EXPECT_THAT(result.output, HasSubstr("3 frames sent"));
  }
  EXPECT_THAT(logged.output, HasSubstr("WARNING"));

  std::ofstream(folder_ + "/a.bin", std::ios::binary) << std::string(16, '\0');
  EXPECT_THAT(write_log({"--source", folder_}).output,
              ContainsRegex("a.bin: none of 1 points .*\n.*over: .*a.bin: none of 1 points"));
}

TEST_F(LaserScannerProgram, SendsIntensitiesAndRingsOfAVelodyneAndReplayKeepsThem) {
  std::ofstream(folder_ + "/a.pcap", std::ios::binary)
      << laser_scanner::pcap_of(laser_scanner::vlp16_turns(2, 4.0));
  ASSERT_EQ(write_log({"--source", folder_ + "/a.pcap"}).exit_code, 0);
  const std::string replayed = folder_ + "/out.log";
  ASSERT_EQ(run({program("limbcast-replay"), log_, replayed}).exit_code, 0);
  for (const std::string& path : {log_, replayed}) {
    const Cloud cloud = first_cloud_in(path);
    ASSERT_EQ(cloud.intensities.size(), cloud.points_m.size());
    ASSERT_EQ(cloud.rings.size(), cloud.points_m.size());
    EXPECT_EQ(cloud.intensities[1], 101.0F);
    EXPECT_EQ(cloud.rings[1], 8);
  }
}

TEST_F(LaserScannerProgram, KeepsAnEarlierLogWhereTheCloudCannotBeRead) {
  write_floor(folder_ + "/a.bin");
  ASSERT_EQ(write_log({"--source", folder_ + "/a.bin"}).exit_code, 0);
  const auto size = std::filesystem::file_size(log_);
  std::ofstream(folder_ + "/broken.pcd") << "# .PCD v0.7\nVERSION 0.7\n";
  EXPECT_EQ(write_log({"--source", folder_ + "/broken.pcd"}).exit_code, kWrongInput);
  EXPECT_EQ(std::filesystem::file_size(log_), size);
}

TEST_F(LaserScannerProgram, GoesOnWithATornRecordingAndSaysSoOnce) {
  const std::string packets = laser_scanner::pcap_of(laser_scanner::vlp16_turns(2, 4.0));
  std::ofstream(folder_ + "/a.pcap", std::ios::binary) << packets.substr(0, packets.size() - 1);
  const RunResult logged = write_log({"--source", folder_ + "/a.pcap"});
  const RunResult sent = run({program("limbcast-laser-scanner"), "--source", folder_ + "/a.pcap",
                              "--lcm-url", private_lcm_url()});
  for (const RunResult& result : {logged, sent}) {
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("a.pcap: is torn, its last 1263 bytes"));
    EXPECT_EQ(result.output.find("torn"), result.output.rfind("torn"));
    EXPECT_THAT(result.output, HasSubstr("1 frames sent"));
  }
}

TEST_F(LaserScannerProgram, SendsIntensitiesOfARecordedScan) {
  const std::string data = LIMBCAST_DATA_DIR;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";
  ASSERT_EQ(write_log({"--source", data + "/clouds/ouster_os0_128_cyclist.pcd", "--axes=-y,-z,x"})
                .exit_code,
            0);
  const Cloud cloud = first_cloud();
  EXPECT_TRUE(cloud.rings.empty());
  ASSERT_EQ(cloud.intensities.size(), cloud.points_m.size());
  const auto [lowest, highest] =
      std::minmax_element(cloud.intensities.begin(), cloud.intensities.end());
  EXPECT_GE(*lowest, 0.0F);
  EXPECT_GT(*highest, 10.0F * (*lowest + 1.0F));
}

TEST_F(LaserScannerProgram, WritesALogOfTheScans) {
  const std::string data = LIMBCAST_DATA_DIR;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";
  const RunResult result = write_log({"--source", data + "/laser_dev"});
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("20 frames sent"));
}

}  // namespace
}  // namespace limbcast::test
