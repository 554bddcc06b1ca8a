#include "common/lcm_io/whole_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "common/config/options.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::lcm_io {
namespace {

namespace fs = std::filesystem;
using ::testing::ExitedWithCode;

class WholeLogFile : public ::testing::Test {
 protected:
  WholeLogFile() {
    LogWriter earlier(path_);
    earlier.write({0, "EARLIER", {1}});
    earlier.close();
  }
  static std::string first_channel_of(const std::string& path) {
    const auto event = LogReader(path).next();
    return event ? event->channel : "none";
  }

  const test::TemporaryFolder folder_;
  const std::string path_ = folder_ / "out.log", unfinished_ = path_ + ".unfinished";
};

TEST_F(WholeLogFile, TakesThePlaceOfAnEarlierOneWhenItIsWhole) {
  WholeLog log(path_);
  log.writer().write({0, "NEW", {1}});
  EXPECT_EQ(first_channel_of(path_), "EARLIER");
  log.finish();
  EXPECT_EQ(first_channel_of(path_), "NEW");
  EXPECT_FALSE(fs::exists(unfinished_));
}

TEST_F(WholeLogFile, IsReadableBesideAnEarlierOneWhereItDoesNotBecomeWhole) {
  {
    WholeLog log(path_);
    log.writer().write({0, "NEW", {1}});
    EXPECT_EQ(log.what_is_left("made"), unfinished_ + " holds what was made so far");
  }
  EXPECT_EQ(first_channel_of(path_), "EARLIER");
  EXPECT_EQ(first_channel_of(unfinished_), "NEW");
}

TEST_F(WholeLogFile, IsNotWhatAnEarlierRunLeftWhereNothingIsWritten) {
  { WholeLog(path_).writer().write({0, "LEFT", {1}}); }
  EXPECT_THROW(WholeLog(path_).finish(), std::runtime_error);
  EXPECT_EQ(first_channel_of(path_), "EARLIER");
  EXPECT_EQ(first_channel_of(unfinished_), "LEFT");
}

TEST_F(WholeLogFile, IsNotMadeWhereNothingIsWritten) {
  {
    const WholeLog log(path_);
    EXPECT_EQ(log.what_is_left("made"), path_ + " was not written");
  }
  EXPECT_EQ(first_channel_of(path_), "EARLIER");
  EXPECT_FALSE(fs::exists(unfinished_));
}

/// On a disk that is full after a few events.
[[noreturn]] void fill_disk(const std::string& path) {
  test::let_files_grow_to(50'000);
  std::exit(config::run_program("tool", [&] {
    WholeLog log(path);
    for (int i = 0; i < 10; ++i)
      log.writer().write({i, "NEW", std::vector<std::uint8_t>(10'000, 1)});
    log.finish();
  }));
}

TEST_F(WholeLogFile, LeavesAnEarlierOneWhereTheDiskIsFull) {
  EXPECT_EXIT(fill_disk(path_), ExitedWithCode(1),
              "tool: " + unfinished_ +
                  ": cannot be written \\(File too large\\); what was written so far is kept\n");
  EXPECT_EQ(first_channel_of(path_), "EARLIER");
  EXPECT_EQ(first_channel_of(unfinished_), "NEW");
}

TEST_F(WholeLogFile, GoesToWhatIsNoFile) {
  WholeLog log("/dev/null");
  log.writer().write({0, "NEW", {1}});
  log.finish();
  EXPECT_FALSE(fs::is_regular_file("/dev/null"));
}

}  // namespace
}  // namespace limbcast::lcm_io
