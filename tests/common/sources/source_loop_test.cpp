#include "common/sources/source_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

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

/// Ends with the program's exit code.
[[noreturn]] void write_interrupted(bool is_live, const std::string& log) {
  std::exit(config::run_program("camera", [&] {
    const SourceProcessOptions options;
    InterruptedSource source(is_live);
    FrameSender<FramePair> sender(options, {}, [](Outlet&, FramePair&) {});
    write_log(source, sender, log);
  }));
}

TEST(WrittenLog, OfARecordingIsNoSuccessWhereItWasInterrupted) {
  const test::TemporaryFolder folder;
  const std::string log = folder / "out.log";
  EXPECT_EXIT(
      write_interrupted(false, log), ExitedWithCode(1),
      HasSubstr("camera: interrupted: 3 of 10 frames; " + log + " holds what was sent so far\n"));
}

TEST(WrittenLog, OfACameraIsCompleteWhenItIsToldToEnd) {
  const test::TemporaryFolder folder;
  EXPECT_EXIT(write_interrupted(true, folder / "out.log"), ExitedWithCode(0), "");
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
