#include "modules/viewer/log_frames.hpp"

#include <gtest/gtest.h>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "tests/support/child_process.hpp"
#include "tests/viewer/scene.hpp"

namespace limbcast::viewer {
namespace {

class LogFramesOf : public ::testing::Test {
 protected:
  const std::string log_ = test::temporary_folder("log_frames") + "/out.log";
};

TEST_F(LogFramesOf, AreGivenInAnyOrder) {
  lcm_io::LogWriter log(log_);
  for (int i = 1; i <= 5; ++i) log.write(i, "POINT_CLOUD", lcm_io::to_message(wall(10 * i)));
  for (int i = 1; i <= 5; ++i) log.write(i, "BODY_POSES", lcm_io::to_message(pointing_arm(10 * i)));
  log.close();
  LogFrames frames(log_, {});
  ASSERT_EQ(frames.count(), 5);
  for (const int number : {4, 0, 2, 2, 1}) {
    const ViewFrame frame = frames.frame(number);
    EXPECT_EQ(frame.number, number);
    EXPECT_EQ(frame.stamp.utime, 10 * (number + 1));
    EXPECT_TRUE(frame.cloud && frame.poses);
  }
}

TEST_F(LogFramesOf, HaveTheirTruthHoweverLateItComesButNotTruthAlone) {
  lcm_io::LogWriter log(log_);
  for (int i = 1; i <= 9; ++i) log.write(i, "BODY_POSES", lcm_io::to_message(pointing_arm(i)));
  for (int i = 1; i <= 12; ++i) log.write(i, "GROUND_TRUTH", lcm_io::to_message(pointing_arm(i)));
  log.close();
  LogFrames frames(log_, {});
  ASSERT_EQ(frames.count(), 9);
  EXPECT_TRUE(frames.frame(0).truth);
  EXPECT_TRUE(frames.frame(8).truth);
}

TEST_F(LogFramesOf, TellHowTheModulesFared) {
  module_status_t status{};
  status.module = "segmenter";
  status.host = "vision";
  lcm_io::LogWriter log(log_);
  for (int i = 1; i <= 2; ++i) {
    log.write(i, "BODY_POSES", lcm_io::to_message(pointing_arm(i)));
    status.rate_out_hz = 10.0F * static_cast<float>(i);
    log.write(i, "MODULE_STATUS", status);
  }
  log.write(3, "BODY_POSES", lcm_io::to_message(pointing_arm(3)));
  log.close();
  LogFrames frames(log_, {});
  EXPECT_TRUE(frames.frame(0).modules.empty());
  ASSERT_EQ(frames.frame(2).modules.size(), 1U);
  EXPECT_EQ(frames.frame(2).modules[0].module, "segmenter");
  EXPECT_DOUBLE_EQ(frames.frame(2).modules[0].rate_out_hz, 20.0);
}

TEST_F(LogFramesOf, LeaveOutAndCountWhatCannotBeDecoded) {
  lcm_io::LogWriter log(log_);
  log.write(1, "BODY_POSES", lcm_io::to_message(pointing_arm(1)));
  log.write(lcm_io::LogEvent{2, "BODY_POSES", {1, 2, 3}});
  log.write(3, "BODY_POSES", lcm_io::to_message(pointing_arm(3)));
  log.close();
  LogFrames frames(log_, {});
  EXPECT_EQ(frames.count(), 2);
  EXPECT_EQ(frames.num_malformed(), 1);
  EXPECT_EQ(frames.frame(1).stamp.utime, 3);
}

}  // namespace
}  // namespace limbcast::viewer
