#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <limbcast/module_status_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/lcm_io/bus.hpp"
#include "tests/stereo_camera/recorded_pairs.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::test {

inline constexpr int kWrongInput = 2;
/// How often a wait looks whether the program ended.
inline constexpr std::chrono::milliseconds kLook{100};

/// The program writing a log.
class StereoCameraProgram : public ::testing::Test {
 protected:
  std::vector<std::string> command(const std::vector<std::string>& options) const {
    std::vector<std::string> words = {program("limbcast-stereo-camera")};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }
  RunResult write_log(const std::vector<std::string>& options) const {
    std::vector<std::string> all = {"--calibration", calibration_, "--log", log_};
    all.insert(all.end(), options.begin(), options.end());
    return run(command(all));
  }
  std::string folder_ = temporary_folder("pairs");
  std::string calibration_ = write_stereo_calibration(folder_);
  std::string log_ = temporary_folder("log") + "/in.log";
};

/// The program publishing on LCM, and what a listener hears.
class PublishingStereoCamera : public StereoCameraProgram {
 protected:
  PublishingStereoCamera() {
    bus_.subscribe<stereo_images_t>(
        "STEREO_IMAGES", lcm_io::Keep::kAll,
        [this](const stereo_images_t& message) { images_.push_back(message); });
    bus_.subscribe<stereo_calibration_t>("STEREO_CALIBRATION", lcm_io::Keep::kAll,
                                         [this](const stereo_calibration_t&) { ++calibrations_; });
    bus_.subscribe<module_status_t>("MODULE_STATUS", lcm_io::Keep::kAll,
                                    [this](const module_status_t& message) {
                                      status_ = message;
                                      ++statuses_;
                                    });
  }
  void start(const std::vector<std::string>& options) {
    std::vector<std::string> all = {"--calibration", calibration_, "--lcm-url", url_};
    all.insert(all.end(), options.begin(), options.end());
    camera_.emplace(command(all), folder_ + "/output.txt");
  }
  /// Fails when the program ends, or says again and again how it is without anything else coming.
  template <class Done>
  ::testing::AssertionResult wait_for(Done done) {
    constexpr int kStatusesInVain = 60;
    const int last_status = statuses_ + kStatusesInVain;
    while (!done()) {
      bus_.handle(kLook);
      if (!done() && (!camera_->running() || statuses_ > last_status)) {
        return ::testing::AssertionFailure()
               << (camera_->running() ? "in vain: " : "ended: ") << camera_->output();
      }
    }
    return ::testing::AssertionSuccess();
  }
  int stop() {
    camera_->signal(SIGTERM);
    return camera_->wait();
  }

  std::string url_ = private_lcm_url();
  lcm_io::Bus bus_{url_};
  std::vector<stereo_images_t> images_;
  int calibrations_ = 0, statuses_ = 0;
  std::optional<module_status_t> status_;
  std::optional<ChildProcess> camera_;
};

}  // namespace limbcast::test
