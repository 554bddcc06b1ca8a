#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/module_status_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <map>
#include <memory>
#include <set>

#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/log_file.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

using lcm_io::Bus;
using lcm_io::Keep;
using std::chrono::milliseconds;

/// How often a wait looks whether something ended that should not have.
constexpr milliseconds kLook{200};

std::set<std::string> channels_of(const std::string& log) {
  std::set<std::string> channels;
  if (std::filesystem::file_size(log) == 0) return channels;
  lcm_io::LogReader reader(log);
  while (const auto event = reader.next()) channels.insert(event->channel);
  return channels;
}

/// Reconstructor, segmenter and pose fitter as processes of their own, and what they send.
class ChainTest : public ::testing::Test {
 protected:
  ChainTest() : url_(private_lcm_url()), folder_(temporary_folder("chain")), bus_(url_) {
    bus_.subscribe<body_poses_t>("BODY_POSES", Keep::kAll,
                                 [this](const body_poses_t& poses) { poses_.push_back(poses); });
    bus_.subscribe<module_status_t>(
        "MODULE_STATUS", Keep::kAll,
        [this](const module_status_t& status) { status_[status.module] = status; });
    for (const char* module : {"reconstructor", "segmenter", "pose-fitter"}) start_module(module);
  }

  void start_module(const std::string& module, const std::vector<std::string>& options = {}) {
    std::vector<std::string> command = {program("limbcast-" + module), "--lcm-url", url_};
    command.insert(command.end(), options.begin(), options.end());
    modules_[module] = std::make_unique<ChildProcess>(command, folder_ + "/" + module + ".txt");
  }
  /// Handles messages until `done`; fails when a process that must live has ended.
  template <class Done>
  ::testing::AssertionResult wait_for(Done done) {
    while (!done()) {
      bus_.handle(kLook);
      for (auto& [name, process] : modules_)
        if (!process->running())
          return ::testing::AssertionFailure() << name << " ended: " << process->output();
    }
    return ::testing::AssertionSuccess();
  }
  bool has_status(const std::string& module) const { return status_.count(module) > 0; }
  ::testing::AssertionResult wait_until_up() {
    return wait_for([this] {
      return has_status("reconstructor") && has_status("segmenter") && has_status("pose_fitter");
    });
  }
  std::unique_ptr<ChildProcess> start_camera(const std::vector<std::string>& options) {
    std::vector<std::string> command = {program("limbcast-stereo-camera"), "--source",
                                        repository_file("logs/multi.log"), "--lcm-url", url_};
    command.insert(command.end(), options.begin(), options.end());
    return std::make_unique<ChildProcess>(command, folder_ + "/camera.txt");
  }

  std::string url_, folder_;
  Bus bus_;
  std::map<std::string, std::unique_ptr<ChildProcess>> modules_;
  std::vector<body_poses_t> poses_;
  std::map<std::string, module_status_t> status_;
};

TEST_F(ChainTest, TurnsRecordedPairsIntoPosesThatLcmLoggerRecords) {
  ASSERT_TRUE(wait_until_up());
  const std::string log = folder_ + "/run.log";
  ChildProcess logger({"lcm-logger", "--quiet", log, "--lcm-url=" + url_}, folder_ + "/logger.txt");
  ASSERT_TRUE(wait_for([&] { return std::filesystem::exists(log); }));
  auto camera = start_camera({"--rate", "2"});
  EXPECT_EQ(camera->wait(), 0) << camera->output();
  EXPECT_TRUE(wait_for([this] {
    return std::any_of(poses_.begin(), poses_.end(),
                       [](const body_poses_t& poses) { return poses.num_persons > 0; });
  })) << "nobody was found";
  // lcm-logger writes what it has heard, but not at once, and drops the rest when it is ended.
  const std::set<std::string> sent = {"BODY_POSES",   "GROUND_TRUTH", "MODULE_STATUS",
                                      "POINT_CLOUD",  "SEGMENTS",     "STEREO_CALIBRATION",
                                      "STEREO_IMAGES"};
  EXPECT_TRUE(wait_for([&] {
    const std::set<std::string> logged = channels_of(log);
    return std::includes(logged.begin(), logged.end(), sent.begin(), sent.end());
  }));
  logger.signal(SIGINT);
  logger.wait();
}

TEST_F(ChainTest, GoesOnWhenAModuleIsKilledAndStartedAgain) {
  ASSERT_TRUE(wait_until_up());
  auto camera = start_camera({"--rate", "4", "--loop"});
  for (const char* module : {"reconstructor", "segmenter", "pose-fitter"}) {
    ASSERT_TRUE(wait_for([this] { return !poses_.empty(); })) << "before " << module;
    modules_[module]->signal(SIGKILL);
    modules_[module]->wait();
    start_module(module);
    poses_.clear();
    ASSERT_TRUE(wait_for([this] { return !poses_.empty(); })) << "after " << module;
  }
  EXPECT_TRUE(camera->running());
}

TEST_F(ChainTest, DropsAForeignMessageOnEveryChannelAndGoesOn) {
  ASSERT_TRUE(wait_until_up());
  const module_status_t foreign = status_["segmenter"];
  for (const char* channel :
       {"STEREO_IMAGES", "DEPTH_IMAGES", "STEREO_CALIBRATION", "POINT_CLOUD", "SEGMENTS"})
    bus_.publish(channel, foreign);
  ASSERT_TRUE(wait_for([this] {
    return status_["reconstructor"].num_malformed >= 1 && status_["segmenter"].num_malformed >= 1 &&
           status_["pose_fitter"].num_malformed >= 1;
  }));
  EXPECT_THAT(status_["segmenter"].last_error, ::testing::HasSubstr("POINT_CLOUD"));
  auto camera = start_camera({"--rate", "4", "--loop"});
  EXPECT_TRUE(wait_for([this] { return !poses_.empty(); }));
}

TEST_F(ChainTest, EndsCleanlyOnSigterm) {
  ASSERT_TRUE(wait_until_up());
  for (auto& [name, process] : modules_) {
    process->signal(SIGTERM);
    EXPECT_EQ(process->wait(), 0) << name << ": " << process->output();
  }
  modules_.clear();
}

}  // namespace
}  // namespace limbcast::test
