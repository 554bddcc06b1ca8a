#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <csignal>
#include <limbcast/module_status_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <optional>

#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/log_file.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

using lcm_io::Keep;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// How often a wait looks whether the program ended.
constexpr std::chrono::milliseconds kLook{200};
constexpr std::int64_t kSecond_us = 1'000'000;

/// The process, fed with the pairs of a log, one each time that a cloud or a status came.
class ReconstructorProgram : public ::testing::Test {
 protected:
  ReconstructorProgram() {
    lcm_io::LogReader log(repository_file("logs/multi.log"));
    while (const auto event = log.next()) {
      if (event->channel == "STEREO_IMAGES")
        pairs_.push_back(lcm_io::decode<stereo_images_t>(event->data));
      if (event->channel == "STEREO_CALIBRATION")
        calibration_ = lcm_io::decode<stereo_calibration_t>(event->data);
    }
    bus_.subscribe<point_cloud_t>("POINT_CLOUD", Keep::kAll,
                                  [this](const point_cloud_t&) { ++num_clouds_; });
    bus_.subscribe<module_status_t>("MODULE_STATUS", Keep::kAll,
                                    [this](const module_status_t& status) { status_ = status; });
  }
  /// Sends the next pair, taken a second after the one before.
  void publish_pair(const stereo_calibration_t& calibration) {
    bus_.publish("STEREO_CALIBRATION", calibration);
    stereo_images_t pair = pairs_[static_cast<std::size_t>(sequence_) % pairs_.size()];
    pair.stamp.sequence = ++sequence_;
    pair.stamp.utime = sequence_ * kSecond_us;
    bus_.publish("STEREO_IMAGES", pair);
  }
  /// Sends pairs until the status is as wanted.
  template <class Wanted>
  ::testing::AssertionResult feed_until(const stereo_calibration_t& calibration, Wanted wanted) {
    while (!status_ || !wanted(*status_)) {
      if (status_) publish_pair(calibration);
      bus_.handle(kLook);
      if (!program_.running())
        return ::testing::AssertionFailure() << "ended: " << program_.output();
    }
    return ::testing::AssertionSuccess();
  }

  std::string url_ = private_lcm_url();
  lcm_io::Bus bus_{url_};
  ChildProcess program_{{program("limbcast-reconstructor"), "--lcm-url", url_},
                        temporary_folder("reconstructor") + "/output.txt"};
  std::vector<stereo_images_t> pairs_;
  stereo_calibration_t calibration_{};
  std::optional<module_status_t> status_;
  std::int64_t sequence_ = 0, num_clouds_ = 0;
};

TEST_F(ReconstructorProgram, WarnsInItsStatusOfACalibrationThatDrifted) {
  StereoCalibration turned = lcm_io::from_message(calibration_);
  turned.R = Eigen::AngleAxisd(0.0035, Eigen::Vector3d::UnitX()) * turned.R;
  turned.rectification.reset();
  const stereo_calibration_t drifted =
      lcm_io::to_message(turned, calibration_.utime, calibration_.sensor);

  // 520 px * 0.0035 = 1.8 px in the middle, up to a fifth more towards the borders.
  ASSERT_TRUE(feed_until(drifted, [](const module_status_t& status) {
    return status.note.find("rows of the two images differ by ") != std::string::npos;
  }));
  EXPECT_THAT(status_->note, HasSubstr("the calibration of 'stereo' has drifted"));
  EXPECT_THAT(status_->note, ContainsRegex("differ by (1.[789]|2.[01]) px"));
  EXPECT_THAT(status_->note, HasSubstr("limbcast-calibrate check"));
  EXPECT_EQ(status_->state, "running");
  EXPECT_THAT(program_.output(), HasSubstr("WARNING the calibration of 'stereo' has drifted"));

  const std::int64_t before = num_clouds_;
  ASSERT_TRUE(feed_until(calibration_, [](const auto& status) { return status.note.empty(); }));
  ASSERT_TRUE(feed_until(calibration_, [&](const auto&) { return num_clouds_ >= before + 20; }));
  EXPECT_EQ(status_->note, "");
}

TEST_F(ReconstructorProgram, WarnsInItsStatusOfARightCameraThatTurnedAboutItsUprightAxis) {
  StereoCalibration turned = lcm_io::from_message(calibration_);
  turned.R = Eigen::AngleAxisd(0.006, Eigen::Vector3d::UnitY()) * turned.R;
  turned.rectification.reset();
  const stereo_calibration_t drifted =
      lcm_io::to_message(turned, calibration_.utime, calibration_.sensor);

  // 520 px * 0.006 = 3.1 px; told gravity is off by half a degree, or 0.5 px, and the first frames
  // of people who hide the ground by as much again.
  ASSERT_TRUE(feed_until(drifted, [](const module_status_t& status) {
    return status.note.find("leans by") != std::string::npos;
  }));
  EXPECT_THAT(status_->note, HasSubstr("the ground before 'stereo' leans by"));
  EXPECT_THAT(status_->note, ContainsRegex("disparities are off by [2-4].[0-9] px"));
  EXPECT_THAT(program_.output(), HasSubstr("WARNING the ground before 'stereo' leans by"));
  ASSERT_TRUE(feed_until(calibration_, [](const auto& status) { return status.note.empty(); }));
}

TEST_F(ReconstructorProgram, WarnsInItsStatusOfTwoCamerasOfOneName) {
  StereoCalibration wider = lcm_io::from_message(calibration_);
  wider.T *= 1.5;
  wider.rectification.reset();
  const stereo_calibration_t other =
      lcm_io::to_message(wider, calibration_.utime, calibration_.sensor);
  bool is_other = false;
  while (!status_ || status_->note.find("two cameras are called 'stereo'") == std::string::npos) {
    is_other = !is_other;
    publish_pair(is_other ? other : calibration_);
    bus_.handle(kLook);
    ASSERT_TRUE(program_.running()) << program_.output();
  }
  EXPECT_THAT(program_.output(), HasSubstr("WARNING two cameras are called 'stereo'"));
}

TEST(NearLimit, IsToldWhereTheImageIsTooNarrowForIt) {
  const std::string out = temporary_folder("near_limit") + "/poses.log";
  const auto replay = [&](const std::string& near_limit_m) {
    return run({program("limbcast-replay"), repository_file("logs/nobody.log"), out,
                "--reconstructor.near-limit-m", near_limit_m});
  };
  const RunResult too_near = replay("0.05");
  EXPECT_EQ(too_near.exit_code, 0);
  EXPECT_THAT(too_near.output, ContainsRegex("nothing nearer than 0.(09|10) m is seen"));
  EXPECT_THAT(replay("0.4").output, ::testing::Not(HasSubstr("nothing nearer")));
}

}  // namespace
}  // namespace limbcast::test
