#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <limbcast/module_status_t.hpp>
#include <optional>

#include "common/lcm_io/bus.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::status {
namespace {

using ::testing::HasSubstr;

class StatusProgram : public ::testing::Test {
 protected:
  test::RunResult once(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command = {test::program("limbcast-status"), "--once", "--lcm-url",
                                        url_};
    command.insert(command.end(), more.begin(), more.end());
    return test::run(command);
  }
  /// Publishes what `status` returns until the program has ended.
  test::RunResult once_while_telling(const module_status_t& status) {
    lcm_io::Bus bus(url_);
    test::ChildProcess program({test::program("limbcast-status"), "--once", "--lcm-url", url_},
                               folder_ + "/status.txt");
    while (program.running()) {
      bus.publish("MODULE_STATUS", status);
      bus.handle(std::chrono::milliseconds(50));
    }
    return {program.wait(), program.output()};
  }
  const std::string url_ = test::private_lcm_url();
  const std::string folder_ = test::temporary_folder("status_program");
};

module_status_t status_of(const std::string& state) {
  module_status_t status{};
  status.module = "segmenter";
  status.host = "vision";
  status.state = state;
  return status;
}

TEST_F(StatusProgram, EndsWithOneWhereNobodyIsHeard) {
  const auto run = once({"--wait-s", "0.2"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("no module was heard"));
}

TEST_F(StatusProgram, ShowsARealModuleAndMissesAnExpectedOne) {
  test::ChildProcess tracker({test::program("limbcast-tracker"), "--lcm-url", url_},
                             folder_ + "/tracker.txt");
  const auto good = once({"--expect", "tracker"});
  EXPECT_EQ(good.exit_code, 0) << good.output;
  EXPECT_THAT(good.output, HasSubstr("waiting"));
  const auto missing = once({"--expect", "tracker,segmenter"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.output, HasSubstr("missing"));
  tracker.signal(SIGTERM);
  EXPECT_EQ(tracker.wait(), 0);
}

TEST_F(StatusProgram, EndsWithOneWhereAModuleFails) {
  EXPECT_EQ(once_while_telling(status_of("running")).exit_code, 0);
  EXPECT_EQ(once_while_telling(status_of("failing")).exit_code, 1);
}

TEST_F(StatusProgram, WritesPlainTablesToAFileUntilItIsTold) {
  lcm_io::Bus bus(url_);
  test::ChildProcess program(
      {test::program("limbcast-status"), "--period-s", "0.2", "--lcm-url", url_},
      folder_ + "/live.txt");
  while (program.running() && program.output().find("vision") == std::string::npos) {
    bus.publish("MODULE_STATUS", status_of("running"));
    bus.handle(std::chrono::milliseconds(50));
  }
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(), 0);
  EXPECT_EQ(program.output().find('\033'), std::string::npos);
}

}  // namespace
}  // namespace limbcast::status
