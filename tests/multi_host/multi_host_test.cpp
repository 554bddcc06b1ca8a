#include <gmock/gmock.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/multi_host/three_hosts.hpp"

namespace limbcast::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class LossyLink : public ThreeHosts, public ::testing::WithParamInterface<Impairment> {
 protected:
  /// Until the reconstructor has worked on all that came after the camera's end.
  ::testing::AssertionResult wait_until_idle() {
    status_.erase("reconstructor");
    return wait_for_status("reconstructor",
                           [](const module_status_t& status) { return status.state == "waiting"; });
  }
};

/// Enough packets for some to be lost at 0.1 %: a frame has 130.
constexpr std::size_t kFramesWatched = 24;

TEST_P(LossyLink, LetsPosesThroughAndItsLossesAreCounted) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  network_->impair("camera", GetParam());
  ASSERT_TRUE(wait_for_sent(kFramesWatched));
  ASSERT_TRUE(poses_resume("a link with losses"));
  stop("limbcast-stereo-camera", SIGTERM);
  ASSERT_TRUE(wait_until_idle());

  const auto arrived = static_cast<std::int64_t>(arrived_.size());
  const std::int64_t lost = *arrived_.rbegin() - *arrived_.begin() + 1 - arrived;
  const module_status_t& status = status_["reconstructor"];
  std::printf("%zu frames sent, %lld lost, %lld skipped\n", sent_.size(),
              static_cast<long long>(lost), static_cast<long long>(status.num_skipped));
  EXPECT_EQ(status.num_lost, lost);
  EXPECT_EQ(status.num_received + status.num_skipped, arrived);
  EXPECT_EQ(status.num_malformed, 0);
  // On the vision host nothing is lost between modules, whatever was lost or skipped before them.
  EXPECT_EQ(status_["segmenter"].num_lost, 0);
  EXPECT_EQ(status_["pose_fitter"].num_lost, 0);
  if (GetParam().loss_percent == 0.0 && GetParam().reorder_percent == 0.0) {
    EXPECT_EQ(lost, 0);
  }
  EXPECT_GT(stop_logger_and_replay(), 0);
}

std::string name_of(const ::testing::TestParamInfo<Impairment>& info) {
  const auto tenths = [](double value) { return std::to_string(std::lround(10.0 * value)); };
  return "LossPermille" + tenths(info.param.loss_percent) + "DelayMs" +
         std::to_string(std::lround(info.param.delay_ms)) + "ReorderPermille" +
         tenths(info.param.reorder_percent);
}

/// Loss [%], delay [ms], reordering [%]; one more from $LIMBCAST_IMPAIRMENT, e.g. "2 20 0.1".
std::vector<Impairment> impairments() {
  std::vector<Impairment> all = {
      {0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 50.0, 0.0}, {0.1, 10.0, 0.5}};
  if (const char* given = std::getenv("LIMBCAST_IMPAIRMENT")) {
    std::istringstream in(given);
    Impairment& last = all.emplace_back();
    in >> last.loss_percent >> last.delay_ms >> last.reorder_percent;
    EXPECT_TRUE(in) << "LIMBCAST_IMPAIRMENT must be three numbers";
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Impairments, LossyLink, ::testing::ValuesIn(impairments()), name_of);

TEST_F(ThreeHosts, GoOnWhileALinkGoesOnLosingPackets) {
  // Fast, so that the kernel's memory for packets with missing pieces would be full early.
  camera_rate_hz_ = "16";
  ASSERT_NO_FATAL_FAILURE(start_robot());
  network_->impair("camera", {1.0, 0.0, 0.0});
  ASSERT_TRUE(wait_for_sent(150));
  EXPECT_TRUE(poses_resume("150 frames with 1 % loss"));
}

TEST_F(ThreeHosts, GoOnWhenAnyProcessIsKilledAndStartedAgain) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  for (const auto& programs : {kCameraPrograms, kVisionPrograms, kOperatorPrograms}) {
    for (const std::string& name : programs) {
      kill(name);
      start(name);
      ASSERT_TRUE(poses_resume("kill -9 and start of " + name)) << name;
    }
  }
  // Until the logger's new log holds a calibration too: it comes once a round of the recording.
  ASSERT_TRUE(wait_for_sent(8));
  EXPECT_GT(stop_logger_and_replay(), 0);
}

TEST_F(ThreeHosts, ReplayTheLogOfALoggerThatWasKilled) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  const std::string torn = log();
  kill("lcm-logger");
  const RunResult result = run({program("limbcast-replay"), torn, folder_ + "/from_torn.log"});
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

TEST_F(ThreeHosts, GoOnAfterTheVisionHostCrashed) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  network_->unplug("vision");
  for (const std::string& name : kVisionPrograms) kill(name);
  ASSERT_TRUE(wait_for_silence());
  network_->plug("vision");
  start(kVisionPrograms);
  EXPECT_TRUE(poses_resume("crash of the vision host"));
}

TEST_F(ThreeHosts, GoOnAfterTheCameraHostCrashed) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  network_->unplug("camera");
  kill("limbcast-stereo-camera");
  network_->plug("camera");
  start("limbcast-stereo-camera");
  EXPECT_TRUE(poses_resume("crash of the camera host"));
}

TEST_F(ThreeHosts, GoOnWhenACableWasPulled) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  for (const char* host : {"camera", "vision", "operator"}) {
    network_->unplug(host);
    ASSERT_TRUE(wait_for_silence()) << host;
    network_->plug(host);
    ASSERT_TRUE(poses_resume(std::string("cable pulled at ") + host)) << host;
  }
}

TEST_F(ThreeHosts, SayWhenAHostsLinkIsDownAndGoOnWhenItIsUp) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  network_->take_down("vision");
  ASSERT_TRUE(wait_for_silence());
  ASSERT_TRUE(wait_for([this] {
    return output_of("limbcast-pose-fitter").find("cannot be sent") != std::string::npos;
  }));
  network_->bring_up("vision");
  ASSERT_TRUE(poses_resume("link down at the vision host"));
  EXPECT_TRUE(wait_for_status("pose_fitter", [](const module_status_t& status) {
    return status.last_error.find("cannot be sent") != std::string::npos;
  }));
}

TEST_F(ThreeHosts, WaitForALinkThatIsDownAtTheStart) {
  network_->take_down("vision");
  start(kVisionPrograms);
  start(kOperatorPrograms);
  start(kCameraPrograms);
  for (const std::string& name : kVisionPrograms)
    ASSERT_TRUE(wait_for([&] { return output_of(name).find("waits") != std::string::npos; }));
  network_->bring_up("vision");
  EXPECT_TRUE(poses_resume("link down at the start"));
}

class JumpingClock : public ThreeHosts {
 protected:
  void SetUp() override {
    ThreeHosts::SetUp();
    if (IsSkipped()) return;
    const std::string library = "/usr/lib/" LIMBCAST_MULTIARCH "/faketime/libfaketime.so.1";
    if (!std::filesystem::exists(library))
      GTEST_SKIP() << library << " is missing: apt-get install libfaketime";
    set_clock("+0");
    camera_environment_ = {"LD_PRELOAD=" + library, "FAKETIME_TIMESTAMP_FILE=" + clock_file(),
                           "FAKETIME_NO_CACHE=1", "FAKETIME_DONT_FAKE_MONOTONIC=1"};
  }
  /// As libfaketime reads it: seconds beside this machine's clock.
  void set_clock(const std::string& offset_s) const { std::ofstream(clock_file()) << offset_s; }
  std::string clock_file() const { return folder_ + "/clock"; }
};

TEST_F(JumpingClock, OfTheCameraHostStopsNothing) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  constexpr std::int64_t kHourUs = 3'600'000'000;
  for (const int hours : {1, -1, 0}) {
    const std::int64_t before = poses_.back().stamp.utime;
    set_clock((hours < 0 ? "" : "+") + std::to_string(3600 * hours));
    ASSERT_TRUE(wait_for([&] {
      return std::abs(poses_.back().stamp.utime - before) > kHourUs / 2;
    })) << "the clock does not jump";
    EXPECT_TRUE(poses_resume("clock jumped to " + std::to_string(hours) + " h"));
  }
  EXPECT_TRUE(wait_for_status("pose_fitter", [](const module_status_t& status) {
    return std::isfinite(status.latency_p50_ms);
  }));
  EXPECT_GT(stop_logger_and_replay(), 0);
}

TEST_F(JumpingClock, IsNamedByTheDoctorOnAnotherHost) {
  set_clock("+60");
  ASSERT_NO_FATAL_FAILURE(start_robot());
  const RunResult result = run_on("operator", "limbcast-doctor");
  EXPECT_EQ(result.exit_code, 1) << result.output;
  EXPECT_THAT(result.output, ContainsRegex("problem  clock of camera: [0-9.]+ ms ahead"));
  EXPECT_THAT(result.output, HasSubstr("good     clock of vision"));
  EXPECT_THAT(result.output, HasSubstr("good     multicast route: by eth0"));
  EXPECT_THAT(result.output, HasSubstr("good     packets with missing pieces"));
  EXPECT_THAT(result.output, HasSubstr("good     module pose_fitter on vision"));
}

TEST_F(ThreeHosts, AreToldByTheDoctorWhatIsMissing) {
  start(kVisionPrograms);
  ASSERT_TRUE(wait_for([this] { return status_.size() == kVisionPrograms.size(); }));
  kill("limbcast-segmenter");
  network_->take_down("operator");
  RunResult result = run_on("operator", "limbcast-doctor");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, HasSubstr("problem  multicast route: none to 239.255.76.67"));
  network_->bring_up("operator");
  result = run_on("operator", "limbcast-doctor");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, HasSubstr("problem  module segmenter: is not heard\n"
                                       "         mend: systemctl start limbcast-segmenter"));
  EXPECT_THAT(result.output, HasSubstr("no camera or laser scanner is heard"));
}

}  // namespace
}  // namespace limbcast::test
