#include "modules/log/cut.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "common/config/options.hpp"
#include "tests/log/logs.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::logs {
namespace {

using ::testing::HasSubstr;

class Cut : public ::testing::Test {
 protected:
  Cut() {
    write_ten_frames(in_);
    options_.in = in_;
    options_.out = out_;
  }
  const std::string folder_ = test::temporary_folder("log_cut");
  const std::string in_ = folder_ + "/in.log", out_ = folder_ + "/out.log";
  CutOptions options_;
};

TEST_F(Cut, OfEverythingIsTheSameFileByteForByte) {
  const CopySummary summary = cut(options_);
  EXPECT_EQ(summary.events_kept, 21);
  EXPECT_EQ(bytes_of(out_), bytes_of(in_));
}

TEST_F(Cut, KeepsWhatIsBeforeTheFirstEventUnlessABeginIsAskedFor) {
  lcm_io::LogWriter log(in_);
  for (const int frame : {5, 3, 4, 6})  // the clock was set back once
    log.write(kBegin + frame * kFrame_us, "BODY_POSES", poses_of_frame(frame));
  log.close();
  EXPECT_EQ(cut(options_).events_kept, 4);
  options_.from_s = 0.0;
  EXPECT_EQ(cut(options_).events_kept, 2);
}

TEST_F(Cut, ByTimeKeepsBytesTimesNumbersAndOrder) {
  options_.from_s = 0.3;
  options_.to_s = 0.5;
  options_.keep_calibration = false;
  cut(options_);
  const auto before = events_in(in_), after = events_in(out_);
  ASSERT_EQ(after.size(), 5U) << "frames 3, 4, 5 and the foreign messages between";
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_TRUE(same(after[i], before[7 + i])) << i;
}

TEST_F(Cut, ByFramesKeepsWhatStandsBetweenThem) {
  options_.from_frame = 3;
  options_.to_frame = 5;
  options_.keep_calibration = false;
  cut(options_);
  const auto before = events_in(in_), after = events_in(out_);
  ASSERT_EQ(after.size(), 5U);
  EXPECT_TRUE(same(after.front(), before[7]));
  EXPECT_TRUE(same(after.back(), before[11]));
}

TEST_F(Cut, ByFramesOfALogThatIsStillWrittenEndsWhereTheLogEndedAtTheBegin) {
  lcm_io::LogWriter log(in_);
  int num_frames = 0;
  const auto write_frame = [&] {
    log.write(kBegin + num_frames * kFrame_us, "BODY_POSES", poses_of_frame(num_frames));
    ++num_frames;
  };
  while (num_frames < 1000) write_frame();
  std::atomic<bool> ends = false;
  std::thread logger([&] {
    while (!ends) write_frame();
  });
  options_.from_frame = 500;
  EXPECT_NO_THROW(cut(options_));
  ends = true;
  logger.join();
  const auto kept = events_in(out_);
  ASSERT_FALSE(kept.empty());
  EXPECT_EQ(kept.front().number, 500);
  EXPECT_EQ(kept.back().number, 499 + static_cast<int>(kept.size()));
}

TEST_F(Cut, KeepsTheLastCalibrationOfEachCameraBeforeThePart) {
  lcm_io::LogWriter log(in_);
  log.write(kBegin, "STEREO_CALIBRATION", calibration_of("front", 0.12));
  log.write(kBegin, "STEREO_CALIBRATION", calibration_of("rear"));
  log.write(kBegin + kFrame_us, "STEREO_CALIBRATION", calibration_of("front", 0.13));
  for (int i = 2; i < 5; ++i) log.write(kBegin + i * kFrame_us, "BODY_POSES", poses_of_frame(i));
  log.write(kBegin + 5 * kFrame_us, "STEREO_CALIBRATION", calibration_of("front", 0.14));
  log.close();
  options_.from_s = 0.35;
  cut(options_);
  const auto before = events_in(in_), after = events_in(out_);
  ASSERT_EQ(after.size(), 4U);
  EXPECT_TRUE(same(after[0], before[1]));
  EXPECT_TRUE(same(after[1], before[2]));
  EXPECT_TRUE(same(after[2], before[5]));
  EXPECT_TRUE(same(after[3], before[6]));
}

TEST_F(Cut, ByChannelsTakesRegularExpressions) {
  options_.channels = ChannelFilter("BODY.*|FOREIGN", "FOR.*");
  EXPECT_EQ(cut(options_).events_kept, 10);
  for (const auto& event : events_in(out_)) EXPECT_EQ(event.channel, "BODY_POSES");
  EXPECT_FALSE(ChannelFilter("BODY").takes("BODY_POSES")) << "the whole name counts";
}

TEST_F(Cut, OfATornAndDamagedLogKeepsAllWholeEvents) {
  std::vector<char> bytes = bytes_of(in_);
  const std::size_t event_bytes = 28 + 7 + 9;  // the last one, foreign
  bytes.resize(bytes.size() - event_bytes / 2);
  // Lengths of the event that begins behind the calibration.
  const std::size_t second = 28 + 18 + events_in(in_)[0].data.size();
  for (std::size_t i = 0; i < 4; ++i) bytes[second + 20 + i] = '\x7f';
  write_bytes(in_, bytes);
  const CopySummary summary = cut(options_);
  EXPECT_EQ(summary.events_kept, 19) << "21 less the damaged and the torn one";
  EXPECT_EQ(summary.torn_bytes, static_cast<std::int64_t>(event_bytes - event_bytes / 2));
  EXPECT_EQ(summary.damaged_bytes,
            static_cast<std::int64_t>(28 + 10 + poses_of_frame(0).getEncodedSize()));
}

TEST_F(Cut, ThatKeepsNothingOrOverwritesItsInputIsRefused) {
  options_.from_s = 100.0;
  EXPECT_THROW(cut(options_), config::UsageError);
  EXPECT_FALSE(std::filesystem::exists(out_));
  options_.from_s = 0.0;
  options_.out = in_;
  EXPECT_EQ(test::error_of<config::UsageError>([this] { cut(options_); }),
            in_ + ": is what is read; choose another OUT.log");
  EXPECT_EQ(events_in(in_).size(), 21U);
  EXPECT_THROW(ChannelFilter("("), config::UsageError);
}

TEST_F(Cut, ThatEndsBeforeItBeginsIsToldByItsOptions) {
  const auto refusal_of = [this](const CutOptions& part) {
    CutOptions options = part;
    options.in = in_;
    options.out = out_;
    return test::error_of<config::UsageError>([&options] { cut(options); });
  };
  CutOptions times, frames;
  times.from_s = 3.0;
  times.to_s = 1.5;
  EXPECT_EQ(refusal_of(times), "--from-s is 3, must not be after --to-s, 1.5");
  frames.from_frame = 30;
  frames.to_frame = 10;
  EXPECT_EQ(refusal_of(frames), "--from-frame is 30, must not be after --to-frame, 10");
}

TEST_F(Cut, ThatIsInterruptedLeavesAnEarlierLog) {
  write_bytes(out_, {'o', 'l', 'd'});
  EXPECT_EXIT(run_interrupted([this] { cut(options_); }), ::testing::ExitedWithCode(1),
              "log: interrupted; " + out_ + " was not written\n");
  EXPECT_EQ(bytes_of(out_).size(), 3U);
}

TEST_F(Cut, ThatIsToldToEndAfterItsLastEventIsWhole) {
  lcm_io::LogWriter log(in_);
  log.write({kBegin, "LARGE", std::vector<std::uint8_t>(100'000)});
  log.close();
  EXPECT_EXIT(run_interrupted_by_last_output(out_, [this] { cut(options_); }),
              ::testing::ExitedWithCode(0), "^$");
}

TEST_F(Cut, WorksFromTheCommandLine) {
  const auto run = test::run({test::program("limbcast-log"), "cut", in_, out_, "--from-frame", "2",
                              "--to-frame=3", "--keep-calibration=false"});
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("3 of 21 events"));
  ASSERT_EQ(
      test::run({test::program("limbcast-log"), "cut", in_, out_, "--channel", "F.*"}).exit_code,
      0);
  EXPECT_EQ(events_in(out_).size(), 10U);
  EXPECT_EQ(test::run({test::program("limbcast-log"), "cut", in_}).exit_code, 2);
  EXPECT_EQ(test::run({test::program("limbcast-log"), "--help"}).exit_code, 0);
}

TEST(LogProgram, NamesItsCommandsWhereNoneOrAnUnknownOneIsGiven) {
  const auto refusal_of = [](const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {test::program("limbcast-log")};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const test::RunResult result = test::run(command);
    EXPECT_EQ(result.exit_code, 2);
    return result.output;
  };
  const std::string commands = "; use info, cut, merge or extract, see limbcast-log --help\n";
  EXPECT_EQ(refusal_of({}), "limbcast-log: command line: no command is given" + commands);
  EXPECT_EQ(refusal_of({"cat", "in.log"}),
            "limbcast-log: command line: 'cat' is no command" + commands);
}

class Merge : public ::testing::Test {
 protected:
  void write(const std::string& path, const std::vector<std::pair<int, std::string>>& events) {
    lcm_io::LogWriter log(path);
    for (const auto& [utime, text] : events) log.write({utime, "C", {text.begin(), text.end()}});
    log.close();
  }
  std::string merged_text() const {
    std::string text;
    for (const auto& event : events_in(out_)) text.append(event.data.begin(), event.data.end());
    return text;
  }
  const std::string folder_ = test::temporary_folder("log_merge");
  const std::string a_ = folder_ + "/a.log", b_ = folder_ + "/b.log", out_ = folder_ + "/out.log";
};

TEST_F(Merge, GoesByTimeAndKeepsTheOrderOfEachLog) {
  write(a_, {{1, "a"}, {5, "c"}, {4, "d"}, {9, "f"}});
  write(b_, {{1, "b"}, {6, "e"}, {10, "g"}});
  EXPECT_EQ(merge({out_, {a_, b_}, false}).events_kept, 7);
  EXPECT_EQ(merged_text(), "abcdefg");
  EXPECT_EQ(events_in(out_).back().number, 6);
}

TEST_F(Merge, KeepsOnceWhatTwoLoggersHeardOnRequest) {
  write(a_, {{1, "x"}, {3, "x"}, {5, "a"}});
  write(b_, {{2, "x"}, {4, "b"}, {6, "a"}});
  EXPECT_EQ(merge({out_, {a_, b_}, false}).events_kept, 6);
  EXPECT_EQ(merge({out_, {a_, b_}, true}).events_kept, 4) << "x twice, as in the first log";
  EXPECT_EQ(merged_text(), "xxba");
}

TEST_F(Merge, KeepsTheSameBytesOfTwoChannels) {
  write(a_, {{1, "x"}});
  lcm_io::LogWriter log(b_);
  log.write({2, "D", {'x'}});
  log.close();
  EXPECT_EQ(merge({out_, {a_, b_}, true}).events_kept, 2);
}

TEST_F(Merge, WorksFromTheCommandLine) {
  write(a_, {{1, "a"}, {4, "c"}});
  write(b_, {{2, "b"}, {5, "c"}});
  const auto run =
      test::run({test::program("limbcast-log"), "merge", out_, a_, b_, "--drop-doubles"});
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("3 of 4 events"));
  EXPECT_EQ(merged_text(), "abc");
  EXPECT_EQ(test::run({test::program("limbcast-log"), "merge", out_}).exit_code, 2);
}

TEST_F(Merge, LosesNoLogWhereTheOneToWriteIsForgotten) {
  write(a_, {{1, "a"}});
  write(b_, {{2, "b"}});
  const auto run = test::run({test::program("limbcast-log"), "merge", a_, b_});
  EXPECT_EQ(run.exit_code, 2) << run.output;
  EXPECT_EQ(run.output, "limbcast-log: command line: " + b_ +
                            " alone gives nothing to merge; give OUT.log and two logs or more\n");
  EXPECT_EQ(lcm_io::LogReader(a_).next()->utime, 1);
}

TEST_F(Merge, ThatIsInterruptedLeavesAnEarlierLogAndKeepsWhatItHasCopied) {
  write(a_, {{1, "a"}, {3, "c"}});
  write(b_, {{2, "b"}, {4, "d"}});
  write(out_, {{0, "earlier"}});
  EXPECT_EXIT(run_interrupted([this] {
                merge({out_, {a_, b_}, false});
              }),
              ::testing::ExitedWithCode(1),
              "log: interrupted; " + out_ + ".unfinished holds what was copied so far\n");
  EXPECT_EQ(merged_text(), "earlier");
  EXPECT_EQ(events_in(out_ + ".unfinished").size(), 2U) << "the first ones were read already";
}

TEST_F(Merge, ThatIsToldToEndAfterItsLastEventIsWhole) {
  write(a_, {{1, "a"}});
  write(b_, {{2, "b"}});
  EXPECT_EXIT(run_interrupted([this] {
                merge({out_, {a_, b_}, false});
              }),
              ::testing::ExitedWithCode(0), "^$")
      << "the first ones were read already";
  EXPECT_EQ(merged_text(), "ab");
}

TEST_F(Merge, RefusesToOverwriteAnInput) {
  write(a_, {{1, "a"}});
  EXPECT_THROW(merge({a_, {a_}, false}), config::UsageError);
  EXPECT_EQ(events_in(a_).size(), 1U);
}

}  // namespace
}  // namespace limbcast::logs
