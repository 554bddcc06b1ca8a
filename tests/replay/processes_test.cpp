#include <gtest/gtest.h>

#include <limbcast/body_poses_t.hpp>
#include <limbcast/module_status_t.hpp>
#include <map>
#include <memory>
#include <set>

#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/encode.hpp"
#include "tests/replay/log_tools.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::replay {
namespace {

using test::ChildProcess;

/// Few, because a frame takes a second of play.
constexpr int kFrames = 4;

/// Without the sequence number: a live module numbers what it sends, however often it is played.
std::vector<std::uint8_t> bytes_of(body_poses_t message) {
  message.stamp.sequence = 0;
  return lcm_io::encode(message);
}

class SeparateProcesses : public ::testing::Test {
 protected:
  SeparateProcesses() : bus_(url_) {
    bus_.subscribe<body_poses_t>(
        "BODY_POSES", lcm_io::Keep::kAll,
        [this](const body_poses_t& poses) { poses_[poses.stamp.utime] = bytes_of(poses); });
    bus_.subscribe<module_status_t>(
        "MODULE_STATUS", lcm_io::Keep::kAll,
        [this](const module_status_t& status) { alive_.insert(status.module); });
    for (const char* module :
         {"limbcast-reconstructor", "limbcast-segmenter", "limbcast-pose-fitter"})
      modules_.push_back(std::make_unique<ChildProcess>(
          std::vector<std::string>{test::program(module), "--lcm-url", url_},
          folder_ + "/" + module + ".txt"));
  }

  void handle() {
    bus_.handle(std::chrono::milliseconds(100));
    for (const auto& module : modules_) ASSERT_TRUE(module->running()) << module->output();
  }

  const std::string url_ = test::private_lcm_url();
  const std::string folder_ = test::temporary_folder("separate_processes");
  std::map<std::int64_t, std::vector<std::uint8_t>> poses_;
  std::set<std::string> alive_;
  std::vector<std::unique_ptr<ChildProcess>> modules_;
  lcm_io::Bus bus_;
};

TEST_F(SeparateProcesses, FedByLcmLogplayerGiveThePosesOfReplay) {
  const std::string in = folder_ + "/in.log", out = folder_ + "/out.log";
  write_events(in, first_frames(test::repository_file("logs/multi.log"), kFrames));
  const auto replayed = test::run({test::program("limbcast-replay"), in, out});
  ASSERT_EQ(replayed.exit_code, 0) << replayed.output;
  const auto expected = on_channel(events_of(out), "BODY_POSES");
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(kFrames));

  while (alive_.size() < modules_.size()) ASSERT_NO_FATAL_FAILURE(handle());
  // Live processes may skip a frame when the machine is busy: play until each came through once.
  while (poses_.size() < expected.size()) {
    ChildProcess player({"lcm-logplayer", "--speed=0.2", "--lcm-url=" + url_, in},
                        folder_ + "/player.txt");
    while (player.running()) ASSERT_NO_FATAL_FAILURE(handle());
    ASSERT_EQ(player.wait(), 0) << player.output();
  }
  for (const lcm_io::LogEvent& event : expected)
    EXPECT_TRUE(poses_[event.utime] == bytes_of(lcm_io::decode<body_poses_t>(event.data)))
        << "other poses at utime " << event.utime;
}

}  // namespace
}  // namespace limbcast::replay
