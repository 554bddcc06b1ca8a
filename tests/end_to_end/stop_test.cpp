#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <limbcast/module_status_t.hpp>
#include <optional>
#include <sstream>

#include "common/lcm_io/bus.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

using ::testing::MatchesRegex;
using ::testing::StartsWith;

struct LiveModule {
  std::string program;
  std::string name;  ///< in its status and its log
  std::vector<std::string> arguments = {};
  /// Where it plays a simulated recording: arguments of limbcast-simulate, the path follows.
  std::vector<std::string> recording = {};
};

std::ostream& operator<<(std::ostream& out, const LiveModule& module) { return out << module.name; }

class EveryModule : public ::testing::TestWithParam<LiveModule> {
 protected:
  EveryModule() : bus_(url_) {
    bus_.subscribe<module_status_t>("MODULE_STATUS", lcm_io::Keep::kAll,
                                    [this](const module_status_t& status) { status_ = status; });
  }
  std::vector<std::string> command() const {
    std::vector<std::string> words = {program(GetParam().program), "--lcm-url", url_};
    words.insert(words.end(), GetParam().arguments.begin(), GetParam().arguments.end());
    if (!GetParam().recording.empty()) words.insert(words.end(), {"--source", recording_});
    return words;
  }
  void make_recording() const {
    if (GetParam().recording.empty()) return;
    std::vector<std::string> words = {program("limbcast-simulate"), "--frames", "1"};
    words.insert(words.end(), GetParam().recording.begin(), GetParam().recording.end());
    words.push_back(recording_);
    const RunResult result = run(words);
    ASSERT_EQ(result.exit_code, 0) << result.output;
  }
  const std::string url_ = private_lcm_url();
  const std::string folder_ = temporary_folder("every_module");
  const std::string recording_ = folder_ + "/recording";
  std::optional<module_status_t> status_;
  lcm_io::Bus bus_;
};

TEST_P(EveryModule, TellsItsStatusAndEndsCleanlyWhenItIsTold) {
  ASSERT_NO_FATAL_FAILURE(make_recording());
  ChildProcess process(command(), folder_ + "/output.txt");
  while (!status_) {
    bus_.handle(std::chrono::milliseconds(100));
    ASSERT_TRUE(process.running()) << process.output();
  }
  EXPECT_EQ(status_->module, GetParam().name);
  EXPECT_EQ(status_->pid, process.pid());
  EXPECT_EQ(status_->version, "0.1.0");
  EXPECT_FALSE(status_->host.empty());
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(), 0) << process.output();

  std::istringstream lines(process.output());
  std::string last;
  for (std::string line; std::getline(lines, line); last = line)
    EXPECT_THAT(line, MatchesRegex(GetParam().name + " (ERROR|WARNING|INFO|DEBUG) .+"));
  EXPECT_THAT(last, MatchesRegex(GetParam().name + " INFO (ends|[0-9]+ frames sent)"));
}

/// A program without status that runs until it is told to end, or for long.
struct LongTool {
  std::string program;
  std::vector<std::string> arguments;
  bool writes;       ///< the last argument is the path to write to
  std::string says;  ///< once it is at work
  int exit_code;
};

std::ostream& operator<<(std::ostream& out, const LongTool& tool) { return out << tool.program; }

class EveryLongTool : public ::testing::TestWithParam<LongTool> {};

TEST_P(EveryLongTool, EndsCleanlyWhenItIsTold) {
  const std::string folder = temporary_folder("every_tool");
  std::vector<std::string> command = {program(GetParam().program), "--lcm-url", private_lcm_url()};
  command.insert(command.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  if (GetParam().writes) command.push_back(folder + "/written");
  ChildProcess process(command, folder + "/output.txt");
  while (process.output().find(GetParam().says) == std::string::npos)
    ASSERT_TRUE(process.running()) << process.output();
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(), GetParam().exit_code) << process.output();
}

TEST(Journal, GetsTheLevelOfEachLineWhereStderrIsItsStream) {
  const std::string output = temporary_folder("journal") + "/stderr.txt";
  std::ofstream(output).flush();
  struct stat file {};
  ASSERT_EQ(stat(output.c_str(), &file), 0);
  const std::string stream =
      "JOURNAL_STREAM=" + std::to_string(file.st_dev) + ":" + std::to_string(file.st_ino);
  ChildProcess failing({program("limbcast-replay"), "/nowhere/in.log", "out.log"}, output,
                       {stream});
  EXPECT_EQ(failing.wait(), 2);
  EXPECT_THAT(failing.output(), StartsWith("<3>limbcast-replay: /nowhere/in.log"));
  ChildProcess elsewhere({program("limbcast-replay"), "/nowhere/in.log", "out.log"}, output,
                         {"JOURNAL_STREAM=1:2"});
  EXPECT_EQ(elsewhere.wait(), 2);
  EXPECT_THAT(elsewhere.output(), StartsWith("limbcast-replay: "));
}

INSTANTIATE_TEST_SUITE_P(
    Modules, EveryModule,
    ::testing::Values(LiveModule{"limbcast-stereo-camera",
                                 "stereo_camera",
                                 {"--source", repository_file("logs/multi.log"), "--loop"}},
                      LiveModule{"limbcast-depth-camera",
                                 "depth_camera",
                                 {"--loop"},
                                 {"--sensor", "depth", "--log"}},
                      LiveModule{"limbcast-laser-scanner",
                                 "laser_scanner",
                                 {"--loop"},
                                 {"--sensor", "laser", "--output"}},
                      LiveModule{"limbcast-simulate", "simulate", {"--frames", "1", "--loop"}},
                      LiveModule{"limbcast-reconstructor", "reconstructor"},
                      LiveModule{"limbcast-segmenter", "segmenter"},
                      LiveModule{"limbcast-pose-fitter", "pose_fitter"},
                      LiveModule{"limbcast-tracker", "tracker"}),
    [](const auto& module) { return module.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Tools, EveryLongTool,
    ::testing::Values(LongTool{"limbcast-status", {"--period-s", "0.1"}, false, "0 modules", 0},
                      LongTool{"limbcast-export-poses", {}, false, "writes BODY_POSES", 0},
                      LongTool{"limbcast-viewer", {"--png"}, true, "shows BODY_POSES", 0},
                      // What is not complete is no success.
                      LongTool{"limbcast-replay",
                               {"--threads", "1", repository_file("logs/demo.log")},
                               true,
                               " of 48 frames",
                               1}),
    [](const auto& tool) {
      std::string name = tool.param.program;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace limbcast::test
