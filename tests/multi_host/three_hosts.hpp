#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/module_status_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/lcm_io/bus.hpp"
#include "tests/multi_host/network.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::test {

/// A robot of three computers that run the real programs: `camera` plays a recording, `vision`
/// makes poses of it, `operator` records with lcm-logger and exports the poses. The test listens on
/// all three. Skipped where this machine lets nobody make network namespaces.
class ThreeHosts : public ::testing::Test {
 protected:
  void SetUp() override;

  /// The programs of each host, in the order in which they are started.
  static const std::vector<std::string> kCameraPrograms, kVisionPrograms, kOperatorPrograms;

  /// Started again where it was killed.
  void start(const std::string& program);
  void start(const std::vector<std::string>& programs);
  /// Starts the three modules of the vision host and the operator's programs, and waits until all
  /// are on the air; then the camera.
  void start_robot();
  void kill(const std::string& program);
  /// Ends it with `signal` and expects that it ends cleanly.
  void stop(const std::string& program, int signal);
  std::string output_of(const std::string& program) const;

  /// Listens until `done`. Fails when a program has ended that nobody killed, or when the camera
  /// has sent so many frames in vain that nothing will come any more.
  ::testing::AssertionResult wait_for(const std::function<bool()>& done);
  /// Until `count` more frames were sent.
  ::testing::AssertionResult wait_for_sent(std::size_t count);
  /// Until frames are sent but no poses come any more.
  ::testing::AssertionResult wait_for_silence();
  /// Until the operator has the poses of `count` frames that are sent from now on. Tells how long
  /// after now, the cause's end, the first came.
  ::testing::AssertionResult poses_resume(const std::string& cause, std::size_t count = 3);
  /// Until the module says on MODULE_STATUS what `told` looks for.
  ::testing::AssertionResult wait_for_status(
      const std::string& module, const std::function<bool(const module_status_t&)>& told);

  /// Runs one of our programs to its end on the host.
  RunResult run_on(const std::string& host, const std::string& name) const;
  /// Ends lcm-logger and replays what it recorded; the number of frames with poses in the replay.
  int stop_logger_and_replay();
  const std::string& log() const { return log_; }

  std::optional<Network> network_;
  std::string folder_, recording_, log_;
  /// For the camera when it starts next: frames a second, and e.g. a clock that jumps.
  std::string camera_rate_hz_ = "4";
  std::vector<std::string> camera_environment_;

  /// Times of the frames as the camera sent them, and sequence numbers as they reached the vision
  /// host.
  std::vector<std::int64_t> sent_;
  std::set<std::int64_t> arrived_;
  std::vector<body_poses_t> poses_;
  std::map<std::string, module_status_t> status_;

 private:
  void replay_recording();
  void listen();
  void handle();
  std::vector<std::string> arguments_of(const std::string& program);
  void check_poses(const body_poses_t& poses) const;

  /// What the chain makes of each frame of the recording, without stamp, as bytes.
  std::vector<std::vector<std::uint8_t>> expected_;
  /// Which frame of the recording the camera sent, by its time.
  std::map<std::int64_t, std::int64_t> recorded_frame_;
  std::map<std::string, std::unique_ptr<ChildProcess>> processes_;
  std::unique_ptr<lcm_io::Bus> camera_bus_, vision_bus_, operator_bus_;
  int starts_ = 0;
};

}  // namespace limbcast::test
