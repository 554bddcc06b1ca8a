#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/module_status_t.hpp>
#include <optional>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/log_file.hpp"
#include "tests/evaluate/figure.hpp"
#include "tests/replay/log_tools.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::tracker {
namespace {

using evaluate::standing_figure;
using replay::events_of;
using replay::on_channel;
using ::testing::HasSubstr;

body_poses_t poses_at(std::int64_t utime, const std::string& sensor, std::int32_t segment) {
  BodyPoses poses;
  poses.stamp.utime = utime;
  poses.stamp.sensor = sensor;
  poses.persons.push_back(standing_figure());
  poses.persons.back().id = segment;
  return lcm_io::to_message(poses);
}

TEST(TrackerProcess, PublishesTrackedPosesWithIdentitiesThatStay) {
  const std::string url = test::private_lcm_url();
  const std::string folder = test::temporary_folder("tracker_process");
  lcm_io::Bus bus(url);
  std::optional<body_poses_t> tracked;
  bool alive = false;
  bus.subscribe<body_poses_t>("TRACKED_POSES", lcm_io::Keep::kAll,
                              [&](const body_poses_t& poses) { tracked = poses; });
  bus.subscribe<module_status_t>("MODULE_STATUS", lcm_io::Keep::kAll,
                                 [&](const module_status_t&) { alive = true; });
  test::ChildProcess process({test::program("limbcast-tracker"), "--lcm-url", url},
                             folder + "/tracker.txt");
  const auto handle = [&] {
    bus.handle(std::chrono::milliseconds(100));
    ASSERT_TRUE(process.running()) << process.output();
  };
  while (!alive) ASSERT_NO_FATAL_FAILURE(handle());
  for (int frame = 0; frame < 3; ++frame) {
    tracked.reset();
    body_poses_t poses = poses_at(1000 + frame * 100'000, "front", 7 * frame);
    // Two were lost before each.
    poses.stamp.sequence = 3 * frame;
    bus.publish("BODY_POSES", poses);
    while (!tracked) ASSERT_NO_FATAL_FAILURE(handle());
    ASSERT_EQ(tracked->num_persons, 1);
    EXPECT_EQ(tracked->persons[0].id, 1);
    EXPECT_EQ(tracked->stamp.utime, 1000 + frame * 100'000);
    // Whoever hears the tracker has not lost them.
    EXPECT_EQ(tracked->stamp.sequence, frame);
  }
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(), 0);
}

TEST(TrackerProcess, TellsOfAFrameThatCameAfterALaterOne) {
  const std::string url = test::private_lcm_url();
  const std::string folder = test::temporary_folder("tracker_late_frame");
  lcm_io::Bus bus(url);
  std::optional<module_status_t> status;
  bus.subscribe<module_status_t>("MODULE_STATUS", lcm_io::Keep::kAll,
                                 [&](const module_status_t& message) { status = message; });
  test::ChildProcess process({test::program("limbcast-tracker"), "--lcm-url", url},
                             folder + "/tracker.txt");
  const auto handle = [&] {
    bus.handle(std::chrono::milliseconds(100));
    ASSERT_TRUE(process.running()) << process.output();
  };
  while (!status) ASSERT_NO_FATAL_FAILURE(handle());
  for (int frame = 0; frame < 2; ++frame) {
    body_poses_t poses = poses_at(1'000'000 - frame * 100'000, "front", 0);
    poses.stamp.sequence = frame;
    bus.publish("BODY_POSES", poses);
    while (status->num_received <= frame) ASSERT_NO_FATAL_FAILURE(handle());
  }
  EXPECT_EQ(status->num_published, 1);
  EXPECT_EQ(status->last_error,
            "BODY_POSES: a frame of 'front' came after a later one and was left out; was the clock "
            "set back?");
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(), 0);
}

class ReplayWithTracker : public ::testing::Test {
 protected:
  ReplayWithTracker() {
    lcm_io::LogWriter log(in_);
    for (int frame = 0; frame < 4; ++frame) {
      log.write(frame, "BODY_POSES", poses_at(1000 + frame * 100'000, "front", frame));
      log.write(frame, "BODY_POSES", poses_at(1000 + frame * 100'000, "rear", frame));
      log.write({frame, "BODY_POSES", {1, 2, 3}});
      log.write({frame, "FOREIGN", {4, 5}});
      log.write(frame, "TRACKED_POSES", poses_at(1, "front", 77));
    }
    log.close();
  }
  const std::string folder_ = test::temporary_folder("replay_with_tracker");
  const std::string in_ = folder_ + "/in.log", out_ = folder_ + "/out.log";
};

TEST_F(ReplayWithTracker, AddsTrackedPosesAfterThePosesOfEachSensor) {
  const auto run = test::run({test::program("limbcast-replay"), "--tracker", in_, out_});
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("4 malformed messages"));
  const auto tracked = on_channel(events_of(out_), "TRACKED_POSES");
  ASSERT_EQ(tracked.size(), 8U) << "old ones left out, new ones for both sensors";
  for (const auto& event : tracked) {
    const auto message = lcm_io::decode<body_poses_t>(event.data);
    ASSERT_EQ(message.num_persons, 1);
    EXPECT_EQ(message.persons[0].id, 1);
  }
  EXPECT_EQ(on_channel(events_of(out_), "FOREIGN").size(), 4U);
}

TEST_F(ReplayWithTracker, CountsFramesThatAreNotTracked) {
  {
    lcm_io::LogWriter log(in_);
    for (const int frame : {0, 3, 1, 2, 4})
      log.write(frame, "BODY_POSES", poses_at(1000 + frame * 100'000, "front", frame));
    log.close();
  }
  const auto run = test::run({test::program("limbcast-replay"), "--tracker", in_, out_});
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("2 frames came after a later one of their sensor"));
  EXPECT_EQ(on_channel(events_of(out_), "TRACKED_POSES").size(), 3U);
}

TEST_F(ReplayWithTracker, NeedsTheTrackerToBeginWithPoses) {
  const auto run = test::run({test::program("limbcast-replay"), "--from", "poses", in_, out_});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, HasSubstr("--tracker"));
}

}  // namespace
}  // namespace limbcast::tracker
