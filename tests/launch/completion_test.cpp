#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::launch {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// What bash offers for the last of these words: the completion is installed under the program's
/// name.
std::string offered(const std::string& name, const std::vector<std::string>& words) {
  const test::TemporaryFolder folder;
  std::filesystem::copy_file(test::repository_file("modules/launch/completion/limbcast"),
                             folder / name);
  const std::string script =
      R"(source "$1"; program=$2; shift 2; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1));)"
      R"( _limbcast "$program"; echo -n "${COMPREPLY[@]}")";
  std::vector<std::string> command = {
      "bash", "-c", script, "completion", folder / name, test::program(name), name};
  command.insert(command.end(), words.begin(), words.end());
  return test::run(command).output;
}

TEST(Completion, OffersTheOptionsOfAProgramThatBeginSo) {
  const std::string options = offered("limbcast-segmenter", {"--lcm"});
  EXPECT_EQ(options, "--lcm-url");
}

TEST(Completion, OffersTheOptionsOfACommand) {
  EXPECT_THAT(offered("limbcast-log", {"cut", "in.log", "--from"}), HasSubstr("--from-s"));
  EXPECT_THAT(offered("limbcast-log", {"info", "in.log", "--"}), Not(HasSubstr("--from-s")));
}

TEST(Completion, LeavesFilesToBash) {
  EXPECT_THAT(offered("limbcast-replay", {""}), IsEmpty());
  EXPECT_EQ(offered("limbcast-replay", {"in.log", "out.log", "--threa"}), "--threads");
}

}  // namespace
}  // namespace limbcast::launch
