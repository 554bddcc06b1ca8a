#include "common/lcm_io/log_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "common/config/options.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::lcm_io {
namespace {

using ::testing::HasSubstr;

class LogFile : public ::testing::Test {
 protected:
  std::string write_three_events() const {
    const std::string path = folder_ / "in.log";
    LogWriter writer(path);
    for (std::uint8_t i = 0; i < 3; ++i) writer.write(LogEvent{100 + i, "CHANNEL", {i, 2, 3}});
    writer.close();
    return path;
  }

  const test::TemporaryFolder folder_;
};

std::string error_of(const std::string& path) {
  try {
    LogReader reader(path);
  } catch (const config::UsageError& error) {
    return error.what();
  }
  return "";
}

TEST_F(LogFile, GivesEventsBackInOrder) {
  LogReader reader(write_three_events());
  for (std::uint8_t i = 0; i < 3; ++i) {
    const auto event = reader.next();
    ASSERT_TRUE(event.has_value());
    EXPECT_EQ(event->utime, 100 + i);
    EXPECT_EQ(event->channel, "CHANNEL");
    EXPECT_EQ(event->data[0], i);
  }
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_EQ(reader.torn_bytes(), 0);
  EXPECT_EQ(reader.damaged_bytes(), 0);
}

TEST_F(LogFile, ReadsATornLogUpToTheTear) {
  const std::string path = write_three_events();
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 2);
  LogReader reader(path);
  EXPECT_TRUE(reader.next().has_value());
  EXPECT_TRUE(reader.next().has_value());
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_GT(reader.torn_bytes(), 0);
}

TEST_F(LogFile, GoesOnBehindADamagedEvent) {
  const std::string path = write_three_events();
  const auto event_bytes = static_cast<std::streamoff>(std::filesystem::file_size(path) / 3);
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    // The second event says that its data is longer than the file.
    constexpr std::streamoff kDataLengthAt = 24;
    file.seekp(event_bytes + kDataLengthAt).put('\x7f');
    // Its last byte is what a sync word begins with.
    file.seekp(2 * event_bytes - 1).put('\xed');
  }
  LogReader reader(path);
  EXPECT_EQ(reader.next()->utime, 100);
  const auto behind = reader.next();
  ASSERT_TRUE(behind.has_value());
  EXPECT_EQ(behind->utime, 102);
  EXPECT_EQ(reader.damaged_bytes(), event_bytes);
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_EQ(reader.torn_bytes(), 0);
}

TEST_F(LogFile, SaysWhatIsWrongWithMissingEmptyAndForeignFiles) {
  EXPECT_THAT(error_of("/nowhere/in.log"), HasSubstr("/nowhere/in.log: no such file"));
  EXPECT_THAT(error_of(folder_.path()), HasSubstr(folder_.path() + ": is a folder; give a log"));
  EXPECT_THAT(error_of(folder_.write("empty.log", "")), HasSubstr("is empty"));
  EXPECT_THAT(error_of(folder_.write("foreign.log", "a text, not a log")),
              HasSubstr("is no LCM log"));
}

TEST_F(LogFile, SaysThatAFileCannotBeWritten) {
  EXPECT_THROW(LogWriter("/nowhere/out.log"), config::UsageError);
  const std::string pipe = folder_ / "pipe_that_nobody_reads";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(LogWriter{pipe}, config::UsageError);
}

TEST_F(LogFile, IsNotWrittenByTwo) {
  const std::string path = folder_ / "out.log";
  LogWriter first(path);
  first.write(LogEvent{1, "CHANNEL", {1, 2, 3}});
  try {
    const LogWriter second(path);
    ADD_FAILURE() << "a second one may write";
  } catch (const config::UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("out.log: is being written by another process"));
  }
  first.close();
  EXPECT_TRUE(LogReader(path).next()) << "what the first one wrote is kept";
}

TEST_F(LogFile, MayBeWrittenAnewWhenItsWriterIsGone) {
  write_three_events();
  EXPECT_NO_THROW(write_three_events());
}

TEST_F(LogFile, SaysThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  LogWriter writer("/dev/full");
  EXPECT_THROW(
      {
        writer.write(LogEvent{1, "CHANNEL", std::vector<std::uint8_t>(100000, 1)});
        writer.close();
      },
      std::runtime_error);
}

}  // namespace
}  // namespace limbcast::lcm_io
