#include "modules/status/status_board.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "common/lcm_io/message_error.hpp"
#include "modules/status/table.hpp"

namespace limbcast::status {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

lcm_io::ModuleStatus status_of(const std::string& host, const std::string& module, int pid,
                               const std::string& state = "running") {
  lcm_io::ModuleStatus status;
  status.host = host;
  status.module = module;
  status.pid = pid;
  status.state = state;
  return status;
}

TEST(StatusBoard, ShowsTheLastStatusOfEachProcessByHost) {
  StatusBoard board;
  board.take(status_of("vision", "segmenter", 2, "waiting"), 0.0);
  board.take(status_of("camera", "stereo_camera", 1), 0.5);
  board.take(status_of("vision", "segmenter", 2, "running"), 1.0);
  const auto rows = board.rows(1.5);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].status.host, "camera");
  EXPECT_DOUBLE_EQ(rows[0].age_s, 1.0);
  EXPECT_EQ(rows[1].state, "running");
}

TEST(StatusBoard, CallsAModuleSilentThatIsNotHeardAnyMoreAndForgetsIt) {
  StatusBoard board;
  board.take(status_of("vision", "segmenter", 2), 0.0);
  EXPECT_FALSE(board.rows(2.9)[0].is_in_error());
  EXPECT_EQ(board.rows(3.1)[0].state, "silent");
  EXPECT_TRUE(board.rows(3.1)[0].is_in_error());
  EXPECT_TRUE(board.rows(61.0).empty());
}

TEST(StatusBoard, LeavesOutASilentProcessThatWasStartedAgain) {
  StatusBoard board;
  board.take(status_of("vision", "segmenter", 2), 0.0);
  board.take(status_of("vision", "segmenter", 9), 5.0);
  const auto rows = board.rows(5.0);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].status.pid, 9);
}

TEST(StatusBoard, KeepsTwoOfAKindThatBothRun) {
  StatusBoard board;
  board.take(status_of("vision", "stereo_camera", 2), 0.0);
  board.take(status_of("vision", "stereo_camera", 3), 0.0);
  EXPECT_EQ(board.rows(1.0).size(), 2U);
}

TEST(StatusBoard, NamesExpectedModulesThatAreNotThere) {
  StatusBoard board({"segmenter", "tracker"});
  board.take(status_of("vision", "segmenter", 2), 0.0);
  const auto rows = board.rows(0.5);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].status.module, "tracker");
  EXPECT_EQ(rows[1].state, "missing");
}

TEST(StatusBoard, HoldsNoMoreThanItsLimit) {
  BoardParams params;
  params.max_modules = 3;
  StatusBoard board({}, params);
  for (int pid = 0; pid < 10; ++pid) board.take(status_of("flood", "x", pid), 0.0);
  EXPECT_EQ(board.rows(0.0).size(), 3U);
}

TEST(StatusTable, ShowsErrorsAndMarksThemOnATerminalOnly) {
  Row row;
  row.status = status_of("vision", "segmenter", 2, "failing");
  row.status.last_error = "SEGMENTS: no ground";
  row.status.latency_p50_ms = 31.6;
  row.state = "failing";
  EXPECT_THAT(table_text({row}), HasSubstr("last error: SEGMENTS: no ground"));
  EXPECT_THAT(table_text({row}), HasSubstr("1 modules, 1 in error"));
  EXPECT_THAT(table_text({row}), HasSubstr("    32      -"));
  EXPECT_THAT(table_text({row}), Not(HasSubstr("\033")));
  EXPECT_THAT(table_text({row}, true), HasSubstr("\033[31m"));
}

TEST(ModuleStatusCodec, RefusesNonsenseAndReplacesControlCharacters) {
  module_status_t message{};
  EXPECT_THROW(lcm_io::from_message(message), lcm_io::MessageError) << "no name";
  message.module = "seg\033[2Jmenter";
  EXPECT_EQ(lcm_io::from_message(message).module, "seg [2Jmenter");
  message.rate_in_hz = std::numeric_limits<float>::infinity();
  EXPECT_THROW(lcm_io::from_message(message), lcm_io::MessageError);
  message.rate_in_hz = 1.0F;
  message.num_lost = -1;
  EXPECT_THROW(lcm_io::from_message(message), lcm_io::MessageError);
}

TEST(ModuleStatusCodec, TellsNoLatencyWhereARecordingIsPlayed) {
  module_status_t message{};
  message.module = "segmenter";
  message.latency_p50_ms = 129.0F;
  message.latency_p99_ms = 29'718'712'320.0F;
  EXPECT_EQ(lcm_io::from_message(message).latency_p50_ms, 129.0);
  EXPECT_FALSE(lcm_io::from_message(message).latency_p99_ms);
  message.latency_p50_ms = -1'000'000'000.0F;  // of a simulated recording that is stamped in 2058
  EXPECT_FALSE(lcm_io::from_message(message).latency_p50_ms);
}

TEST(ModuleStatusCodec, TellsAgesOfAClockThatIsALittleAhead) {
  module_status_t message{};
  message.module = "segmenter";
  message.latency_p50_ms = -5.0F;
  EXPECT_EQ(lcm_io::from_message(message).latency_p50_ms, -5.0);
}

}  // namespace
}  // namespace limbcast::status
