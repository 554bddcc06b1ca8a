#include "common/sources/source_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "common/lcm_io/stamp_codec.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

using ::testing::AllOf;
using ::testing::ExitedWithCode;
using ::testing::HasSubstr;

constexpr int kFrames = 10, kStopAt = 3;

/// Tells the program to end with its third frame.
class InterruptedSource : public PairSource {
 public:
  explicit InterruptedSource(bool is_live) : is_live_(is_live) {}

  std::optional<FramePair> next() override {
    if (++given_ == kStopAt) lcm_io::request_stop();
    return FramePair{};
  }
  bool ended() const override { return given_ >= kFrames; }
  bool live() const override { return is_live_; }
  std::optional<std::int64_t> num_frames() const override { return kFrames; }
  std::string description() const override { return "ten frames"; }

 private:
  bool is_live_;
  int given_ = 0;
};

/// A video: that its only frame was the last is found when there is no next one. Tells the program
/// to end with that frame.
class InterruptedVideo : public PairSource {
 public:
  std::optional<FramePair> next() override {
    lcm_io::request_stop();
    ended_ = given_;
    if (ended_) return std::nullopt;
    given_ = true;
    return FramePair{};
  }
  bool ended() const override { return ended_; }
  bool live() const override { return false; }
  std::string description() const override { return "a video"; }

 private:
  bool given_ = false, ended_ = false;
};

/// A folder whose second pair is bad.
class TornSource : public PairSource {
 public:
  std::optional<FramePair> next() override {
    if (given_++ > 0) throw InputError("second_left.jpg: is torn");
    return FramePair{};
  }
  bool ended() const override { return false; }
  bool live() const override { return false; }
  std::string description() const override { return "a torn folder"; }

 private:
  int given_ = 0;
};

/// Is switched off before it gives anything.
class SilentSource : public PairSource {
 public:
  std::optional<FramePair> next() override {
    lcm_io::request_stop();
    return std::nullopt;
  }
  bool ended() const override { return false; }
  bool live() const override { return true; }
  std::string description() const override { return "nothing"; }
};

/// Ends with the program's exit code.
[[noreturn]] void write_and_exit(PairSource&& source, const std::string& log) {
  std::exit(config::run_program("camera", [&] {
    const SourceProcessOptions options;
    FrameSender<FramePair> sender(options, {}, [](Outlet& outlet, FramePair& frame) {
      outlet.send(0, "FRAMES", lcm_io::to_message(frame.stamp));
    });
    write_log(source, sender, log);
  }));
}

std::string first_channel_of(const std::string& log) {
  const auto event = lcm_io::LogReader(log).next();
  return event ? event->channel : "none";
}

std::string earlier_log(const test::TemporaryFolder& folder) {
  const std::string path = folder / "out.log";
  lcm_io::LogWriter log(path);
  log.write(0, "EARLIER", lcm_io::to_message(Stamp{}));
  log.close();
  return path;
}

TEST(WrittenLog, OfARecordingIsNoSuccessWhereItWasInterrupted) {
  const test::TemporaryFolder folder;
  const std::string log = folder / "out.log";
  EXPECT_EXIT(write_and_exit(InterruptedSource(false), log), ExitedWithCode(1),
              HasSubstr("camera: interrupted: 3 of 10 frames; " + log +
                        ".unfinished holds what was sent so far\n"));
}

TEST(WrittenLog, OfARecordingIsWholeWhereTheProgramIsToldToEndAfterItsLastFrame) {
  const test::TemporaryFolder folder;
  const std::string log = folder / "out.log";
  EXPECT_EXIT(write_and_exit(InterruptedVideo(), log), ExitedWithCode(0), "");
  EXPECT_EQ(first_channel_of(log), "FRAMES");
}

TEST(WrittenLog, OfACameraIsCompleteWhenItIsToldToEnd) {
  const test::TemporaryFolder folder;
  const std::string log = earlier_log(folder);
  EXPECT_EXIT(write_and_exit(InterruptedSource(true), log), ExitedWithCode(0), "");
  EXPECT_EQ(first_channel_of(log), "FRAMES");
  EXPECT_FALSE(std::filesystem::exists(log + ".unfinished"));
}

TEST(WrittenLog, LeavesAnEarlierOneWhereItsSourceFailsInTheMiddle) {
  const test::TemporaryFolder folder;
  const std::string log = earlier_log(folder);
  EXPECT_EXIT(write_and_exit(TornSource(), log), ExitedWithCode(2),
              AllOf(HasSubstr(log + ".unfinished holds what was sent so far\n"),
                    HasSubstr("camera: second_left.jpg: is torn\n")));
  EXPECT_EQ(first_channel_of(log), "EARLIER");
  EXPECT_EQ(first_channel_of(log + ".unfinished"), "FRAMES");
}

TEST(WrittenLog, IsMissedWhereNoFrameCame) {
  const test::TemporaryFolder folder;
  const std::string log = folder / "out.log";
  EXPECT_EXIT(write_and_exit(SilentSource(), log), ExitedWithCode(1),
              HasSubstr("camera: " + log + ": was not written, as no frame came\n"));
}

TEST(WrittenLog, GoesToWhatIsNoFile) {
  EXPECT_EXIT(write_and_exit(InterruptedSource(true), "/dev/null"), ExitedWithCode(0), "");
  EXPECT_FALSE(std::filesystem::is_regular_file("/dev/null"));
}

TEST(WrittenLog, IsRefusedOverAnyFileThatIsRead) {
  const test::TemporaryFolder folder;
  SourceProcessOptions options;
  options.source.source = folder.write("left.avi", "");
  options.source.second_source = folder.write("right.avi", "");
  options.calibration = folder.write("calibration/left.yaml", "");
  std::filesystem::create_symlink("right.avi", folder / "link");
  for (const char* name : {"left.avi", "link", "calibration/left.yaml"}) {
    options.log = folder / name;
    EXPECT_EQ(test::error_of<config::UsageError>([&] { check_log_file(options); }),
              options.log + ": is what is read; choose another --log");
  }
  options.log = folder.write("old.log", "");
  EXPECT_NO_THROW(check_log_file(options));
  options.source.source = folder.path();
  EXPECT_NO_THROW(check_log_file(options));
}

}  // namespace
}  // namespace limbcast
