#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/depth_images_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>

#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/log_file.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

using lcm_io::Keep;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// How often a wait looks whether the program ended.
constexpr std::chrono::milliseconds kLook{200};

std::vector<std::string> command(const std::string& sensor,
                                 const std::vector<std::string>& options) {
  std::vector<std::string> words = {program("limbcast-simulate"),
                                    "--sensor",
                                    sensor,
                                    "--frames",
                                    "2",
                                    "--width-px",
                                    "160",
                                    "--height-px",
                                    "120",
                                    "--focal-px",
                                    "130"};
  if (sensor == "laser") words.insert(words.end(), {"--rings", "32", "--azimuth-step-deg", "1"});
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

class SimulateProgram : public ::testing::TestWithParam<const char*> {};

TEST_P(SimulateProgram, WritesTheSameLogAgainAndAnotherWithAnotherSeed) {
  const std::string folder = temporary_folder("logs");
  const auto log_of = [&](const std::string& name, const std::string& seed) {
    const std::string path = folder + "/" + name;
    const RunResult result =
        run(command(GetParam(), {"--log", path, "--seed", seed, "--set", "sequence"}));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string first = log_of("first.log", "4");
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(first == log_of("again.log", "4"));
  EXPECT_FALSE(first == log_of("other.log", "5"));
}

/// What is heard while the program runs round and round through its frames.
TEST_P(SimulateProgram, PublishesItsFramesAndTheirTruthLive) {
  const std::string url = private_lcm_url();
  lcm_io::Bus bus(url);
  const std::string sensor = GetParam();
  int frames = 0;
  int calibrations = 0;
  std::vector<body_poses_t> truths;
  const auto count_frame = [&](const auto&) { ++frames; };
  if (sensor == "stereo") bus.subscribe<stereo_images_t>("STEREO_IMAGES", Keep::kAll, count_frame);
  if (sensor == "depth") bus.subscribe<depth_images_t>("DEPTH_IMAGES", Keep::kAll, count_frame);
  if (sensor == "laser") bus.subscribe<point_cloud_t>("POINT_CLOUD", Keep::kAll, count_frame);
  bus.subscribe<stereo_calibration_t>("STEREO_CALIBRATION", Keep::kAll,
                                      [&](const stereo_calibration_t&) { ++calibrations; });
  bus.subscribe<body_poses_t>("GROUND_TRUTH", Keep::kAll,
                              [&](const body_poses_t& poses) { truths.push_back(poses); });
  ChildProcess simulate(command(sensor, {"--loop", "--rate", "20", "--lcm-url", url}),
                        temporary_folder("live") + "/output.txt");

  while (frames < 5 || truths.size() < 5) {
    bus.handle(kLook);
    ASSERT_TRUE(simulate.running()) << simulate.output();
  }

  EXPECT_EQ(calibrations > 0, sensor == "stereo");
  EXPECT_EQ(truths[0].num_persons, 1);
  EXPECT_LT(truths[0].stamp.utime, truths[4].stamp.utime);
  simulate.signal(SIGTERM);
  EXPECT_EQ(simulate.wait(), 0) << simulate.output();
}

TEST(SimulatedLog, IsReadableBesideAnEarlierOneWhereItWasInterrupted) {
  const std::string folder = temporary_folder("interrupted"), log = folder + "/in.log";
  ASSERT_EQ(run(command("laser", {"--log", log})).exit_code, 0);
  const auto earlier_bytes = std::filesystem::file_size(log);
  ChildProcess simulate(command("laser", {"--log", log, "--frames", "100000"}),
                        folder + "/output.txt");
  while (simulate.output().find(" of 100000 frames made") == std::string::npos)
    ASSERT_TRUE(simulate.running()) << simulate.output();
  simulate.signal(SIGTERM);
  EXPECT_EQ(simulate.wait(), 1);
  EXPECT_THAT(simulate.output(),
              HasSubstr(" of 100000 frames; " + log + ".unfinished holds what was made so far\n"));
  EXPECT_EQ(std::filesystem::file_size(log), earlier_bytes);
  EXPECT_EQ(lcm_io::LogReader(log + ".unfinished").next()->channel, "POINT_CLOUD");
}

TEST(SimulateReport, TellsOfTheDistancesSoFarWhereItIsInterrupted) {
  const std::string folder = temporary_folder("report");
  std::vector<std::string> words = command("stereo-depth", {"--report", "--report-frames", "1"});
  words.erase(words.begin() + 3, words.begin() + 5);  // --frames
  ChildProcess simulate(words, folder + "/output.txt");
  while (simulate.output().find("1.5 m done") == std::string::npos)
    ASSERT_TRUE(simulate.running()) << simulate.output();
  simulate.signal(SIGTERM);
  EXPECT_EQ(simulate.wait(), 1);
  EXPECT_THAT(simulate.output(), HasSubstr("   1.5 m "));
  EXPECT_THAT(simulate.output(), ContainsRegex("interrupted: [1-9] of 10 distances\n"));
}

TEST(SimulateUsage, RefusesOptionsOfAnotherSetOrOutput) {
  const auto error = [](const std::vector<std::string>& options) {
    const RunResult result = run(command("depth", options));
    EXPECT_EQ(result.exit_code, 2);
    return result.output;
  };
  const std::string folder = temporary_folder("usage") + "/out";
  EXPECT_EQ(error({"--output", folder, "--set", "pointing", "--posture", "T"}),
            "limbcast-simulate: --posture is of the sets general and multi, not of pointing\n");
  EXPECT_EQ(error({"--output", folder, "--set", "general", "--motion", "wave"}),
            "limbcast-simulate: --motion is of the set sequence, not of general\n");
  EXPECT_EQ(error({"--output", folder, "--loop"}),
            "limbcast-simulate: --loop is of live frames; leave it out with --output or --log\n");
  EXPECT_EQ(error({"--report", "--report-from-m", "5", "--report-to-m", "2"}),
            "limbcast-simulate: --report-from-m must not be more than --report-to-m\n");
  EXPECT_EQ(error({"--log", "/none/a.log"}),
            "limbcast-simulate: /none/a.log: there is no folder /none; make it or choose another "
            "--log\n");
}

TEST(SimulateUsage, RefusesOptionsThatWouldSayNothing) {
  const std::string folder = temporary_folder("idle");
  const auto expect_left_out = [&folder](const std::string& sensor, std::vector<std::string> given,
                                         const std::string& words) {
    given.insert(given.end(), {"--lcm-url", "none"});
    const RunResult result = run(command(sensor, given));
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.output, "limbcast-simulate: command line: leave out " + words + "\n");
  };
  expect_left_out("depth", {"--organised", "--rings", "16"},
                  "rings, organised (for the sensor laser only)");
  expect_left_out("laser", {"--baseline-m", "0.1"},
                  "baseline-m (for the sensors stereo and stereo-depth only)");
  expect_left_out("laser", {"--color"}, "color (for the sensors stereo-depth and depth only)");
  expect_left_out("depth", {"--stereo-images-channel", "PAIRS"},
                  "stereo-images-channel (for the sensor stereo only)");
  expect_left_out("depth", {"--set", "sequence", "--occluder-share", "1"},
                  "occluder-share (for other sets than sequence)");
  expect_left_out("depth", {"--set", "sequence", "--head-above-share", "1"},
                  "head-above-share (for other sets than sequence)");
  expect_left_out(
      "depth",
      {"--set", "nohuman", "--coat-share", "1", "--head-above-share", "1", "--max-distance-m", "3"},
      "head-above-share, coat-share (for frames with people only)");
  expect_left_out("depth", {"--report-to-m", "5"}, "report-to-m (with --report only)");
  expect_left_out("depth", {"--log", folder + "/in.log", "--rate", "5"},
                  "rate (for live frames only)");
  expect_left_out("depth", {"--output", folder + "/out", "--sensor-name", "front"},
                  "sensor-name (for logs and live frames only)");
  expect_left_out("depth", {"--log", folder + "/in.log", "--blind"},
                  "blind (for pictures in a folder only)");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(SimulateUsage, TakesOptionsOfAllSensorsFromAConfigurationFile) {
  const std::string folder = temporary_folder("shared");
  std::ofstream(folder + "/robot.conf") << "[simulate]\nrings = 16\nbaseline_m = 0.1\n";
  const RunResult result =
      run(command("depth", {"--config", folder + "/robot.conf", "--log", folder + "/in.log"}));
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

INSTANTIATE_TEST_SUITE_P(Sensors, SimulateProgram, ::testing::Values("stereo", "depth", "laser"),
                         [](const auto& sensor) { return std::string(sensor.param); });

}  // namespace
}  // namespace limbcast::test
