#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

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
  std::vector<std::string> arguments;
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
    return words;
  }
  const std::string url_ = private_lcm_url();
  const std::string folder_ = temporary_folder("every_module");
  std::optional<module_status_t> status_;
  lcm_io::Bus bus_;
};

TEST_P(EveryModule, TellsItsStatusAndEndsCleanlyWhenItIsTold) {
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
  for (std::string line; std::getline(lines, line);)
    EXPECT_THAT(line, MatchesRegex(GetParam().name + " (ERROR|WARNING|INFO|DEBUG) .+"));
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
                      LiveModule{"limbcast-reconstructor", "reconstructor", {}},
                      LiveModule{"limbcast-segmenter", "segmenter", {}},
                      LiveModule{"limbcast-pose-fitter", "pose_fitter", {}},
                      LiveModule{"limbcast-tracker", "tracker", {}}),
    [](const auto& module) { return module.param.name; });

}  // namespace
}  // namespace limbcast::test
