#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kNotTaken = 2;

/// A script that users start.
class Script : public ::testing::TestWithParam<const char*> {
 protected:
  std::string script_ = repository_file(GetParam());
};

TEST_P(Script, PrintsTheCommentThatItBeginsWithAsItsHelp) {
  for (const char* option : {"--help", "-h"}) {
    const RunResult result = run({script_, option});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr(GetParam())) << "how it is called";
    EXPECT_THAT(result.output, Not(HasSubstr("set -euo")));
    EXPECT_NE(result.output.front(), '#');
  }
}

TEST_P(Script, RefusesArgumentsThatItDoesNotKnow) {
  const RunResult result = run({script_, "--fast"});
  EXPECT_EQ(result.exit_code, kNotTaken) << result.output;
  EXPECT_THAT(result.output, HasSubstr(": --fast: "));
  EXPECT_THAT(result.output, EndsWith("; see " + script_ + " --help\n"));
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

INSTANTIATE_TEST_SUITE_P(
    Scripts, Script,
    ::testing::Values("logs/make_logs.sh", "modules/demo.sh", "modules/install_dependencies.sh",
                      "modules/segmenter/models/fetch.sh", "tests/accuracy/check_bars.sh",
                      "tests/accuracy/conditions.sh", "tests/accuracy/figures.sh",
                      "tests/accuracy/measure.sh", "tests/accuracy/sensors.sh",
                      "tests/accuracy/simulated.sh", "tests/arm64/cross.sh",
                      "tests/packages/bare_debian.sh", "tests/pose_fitter/train.sh",
                      "tests/replay/update_golden.sh", "tests/run.sh", "tests/segmenter/train.sh",
                      "tests/segmenter/train_depth_pose.sh"));

TEST(RunScript, RefusesWhatCtestWouldPassOver) {
  const std::string script = repository_file("tests/run.sh");
  for (const std::string word : {"Segmenter", "--test-regexp=Segmenter", "-Rx"}) {
    const RunResult result = run({script, word});
    EXPECT_EQ(result.exit_code, kNotTaken);
    EXPECT_EQ(result.output,
              "run: " + word + ": is no option of ctest; see " + script + " --help\n");
  }
}

TEST(InstallDependencies, TakesRunOrTestAlone) {
  const std::string script = repository_file("modules/install_dependencies.sh");
  const std::string end = "; see " + script + " --help\n";
  const RunResult both = run({script, "run", "test"});
  EXPECT_EQ(both.exit_code, kNotTaken);
  EXPECT_EQ(both.output, "install_dependencies: test: one argument too many" + end);
  const RunResult unknown = run({script, "nonsense"});
  EXPECT_EQ(unknown.exit_code, kNotTaken);
  EXPECT_EQ(unknown.output, "install_dependencies: nonsense: give run or test" + end);
}

}  // namespace
}  // namespace limbcast::test
