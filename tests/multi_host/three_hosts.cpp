#include "tests/multi_host/three_hosts.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>

#include "common/lcm_io/encode.hpp"
#include "tests/replay/log_tools.hpp"

namespace limbcast::test {
namespace {

using lcm_io::Keep;
using std::chrono::milliseconds;

const std::vector<std::string> kHosts = {"camera", "vision", "operator"};
/// As modules/launch sets it; the network is this test's own, so is the port.
constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4000000";
/// How often a wait looks whether something ended that should not have.
constexpr milliseconds kLook{20};
/// Frames of the recording, played again and again.
constexpr int kRecordedFrames = 6;
/// What modules/launch sets for the kernel; those of net.core are the real machine's.
constexpr const char* kKernelSettings = "modules/launch/sysctl/60-limbcast.conf";
/// Half the camera's size, so that a busy machine of two cores keeps up.
constexpr const char* kImageScale = "0.5";
/// Frames without poses after which none are on their way any more.
constexpr std::size_t kSilentFrames = 8;
/// Frames sent in vain after which a wait is given up: with 1 % loss one in four gets through.
constexpr std::size_t kVainFrames = 200;

std::vector<std::uint8_t> bytes_without_stamp(body_poses_t poses) {
  poses.stamp = stamp_t{};
  return lcm_io::encode(poses);
}

std::string host_of(const std::string& program) {
  if (program == "limbcast-stereo-camera") return "camera";
  return program == "lcm-logger" || program == "limbcast-export-poses" ? "operator" : "vision";
}

}  // namespace

const std::vector<std::string> ThreeHosts::kCameraPrograms = {"limbcast-stereo-camera"};
const std::vector<std::string> ThreeHosts::kVisionPrograms = {
    "limbcast-reconstructor", "limbcast-segmenter", "limbcast-pose-fitter"};
const std::vector<std::string> ThreeHosts::kOperatorPrograms = {"lcm-logger",
                                                                "limbcast-export-poses"};

void ThreeHosts::SetUp() {
  if (const auto reason = Network::why_impossible()) GTEST_SKIP() << *reason;
  folder_ = temporary_folder("three_hosts");
  recording_ = folder_ + "/recording.log";
  network_.emplace(kHosts);
  for (const std::string& host : kHosts)
    network_->set_kernel(host, repository_file(kKernelSettings));
  replay_recording();
  listen();
}

void ThreeHosts::replay_recording() {
  using namespace replay;
  write_events(recording_, first_frames(repository_file("logs/demo.log"), kRecordedFrames));
  const std::string out = folder_ + "/expected.log";
  const RunResult result = run({program("limbcast-replay"), recording_, out,
                                std::string("--reconstructor.image-scale=") + kImageScale});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  for (const lcm_io::LogEvent& event : on_channel(events_of(out), "BODY_POSES"))
    expected_.push_back(bytes_without_stamp(lcm_io::decode<body_poses_t>(event.data)));
  ASSERT_EQ(expected_.size(), static_cast<std::size_t>(kRecordedFrames));
}

void ThreeHosts::listen() {
  const auto bus_on = [this](const std::string& host) {
    const InNamespace inside(network_->namespace_of(host));
    return std::make_unique<lcm_io::Bus>(kUrl);
  };
  camera_bus_ = bus_on("camera");
  vision_bus_ = bus_on("vision");
  operator_bus_ = bus_on("operator");
  // Sockets are opened by the first subscription.
  {
    const InNamespace inside(network_->namespace_of("camera"));
    camera_bus_->subscribe<stereo_images_t>(
        "STEREO_IMAGES", Keep::kAll, [this](const stereo_images_t& images) {
          sent_.push_back(images.stamp.utime);
          recorded_frame_[images.stamp.utime] = images.stamp.sequence % kRecordedFrames;
        });
  }
  {
    const InNamespace inside(network_->namespace_of("vision"));
    vision_bus_->subscribe<stereo_images_t>(
        "STEREO_IMAGES", Keep::kAll,
        [this](const stereo_images_t& images) { arrived_.insert(images.stamp.sequence); });
  }
  const InNamespace inside(network_->namespace_of("operator"));
  operator_bus_->subscribe<body_poses_t>("BODY_POSES", Keep::kAll,
                                         [this](const body_poses_t& poses) {
                                           check_poses(poses);
                                           poses_.push_back(poses);
                                         });
  operator_bus_->subscribe<module_status_t>(
      "MODULE_STATUS", Keep::kAll,
      [this](const module_status_t& status) { status_[status.module] = status; });
}

void ThreeHosts::check_poses(const body_poses_t& poses) const {
  const auto frame = recorded_frame_.find(poses.stamp.utime);
  // On a busy machine the test itself may have missed the images.
  if (frame == recorded_frame_.end()) return;
  EXPECT_TRUE(bytes_without_stamp(poses) == expected_[static_cast<std::size_t>(frame->second)])
      << "other poses than the replay's for frame " << frame->second;
}

std::vector<std::string> ThreeHosts::arguments_of(const std::string& name) {
  const std::string url = std::string("--lcm-url=") + kUrl;
  if (name == "lcm-logger") {
    log_ = folder_ + "/run." + std::to_string(starts_) + ".log";
    return {"lcm-logger", "--quiet", url, log_};
  }
  std::vector<std::string> command = {program(name), url};
  if (name == "limbcast-reconstructor")
    command.insert(command.end(), {"--image-scale", kImageScale});
  if (name == "limbcast-stereo-camera") {
    command.insert(command.end(),
                   {"--source", recording_, "--rate", camera_rate_hz_, "--loop", "--restamp"});
    command.insert(command.begin(), camera_environment_.begin(), camera_environment_.end());
    command.insert(command.begin(), "env");
  }
  return command;
}

void ThreeHosts::start(const std::string& name) {
  ++starts_;
  processes_[name] =
      std::make_unique<ChildProcess>(network_->on_host(host_of(name), arguments_of(name)),
                                     folder_ + "/" + name + "." + std::to_string(starts_) + ".txt");
}

void ThreeHosts::start(const std::vector<std::string>& programs) {
  for (const std::string& name : programs) start(name);
}

void ThreeHosts::start_robot() {
  start(kVisionPrograms);
  start(kOperatorPrograms);
  ASSERT_TRUE(wait_for([this] { return status_.size() == kVisionPrograms.size(); }));
  start(kCameraPrograms);
  ASSERT_TRUE(poses_resume("start"));
}

void ThreeHosts::kill(const std::string& name) {
  processes_.at(name)->signal(SIGKILL);
  processes_.at(name)->wait();
  processes_.erase(name);
}

void ThreeHosts::stop(const std::string& name, int signal) {
  processes_.at(name)->signal(signal);
  EXPECT_EQ(processes_.at(name)->wait(), 0) << name << ": " << processes_.at(name)->output();
  processes_.erase(name);
}

std::string ThreeHosts::output_of(const std::string& name) const {
  return processes_.at(name)->output();
}

void ThreeHosts::handle() {
  // The images first: the poses are compared by them.
  while (camera_bus_->handle(milliseconds(0))) continue;
  operator_bus_->handle(kLook);
  while (operator_bus_->handle(milliseconds(0))) continue;
  while (vision_bus_->handle(milliseconds(0))) continue;
}

::testing::AssertionResult ThreeHosts::wait_for(const std::function<bool()>& done) {
  const std::size_t sent_before = sent_.size();
  while (!done()) {
    handle();
    for (const auto& [name, process] : processes_)
      if (!process->running())
        return ::testing::AssertionFailure() << name << " ended: " << process->output();
    if (sent_.size() > sent_before + kVainFrames)
      return ::testing::AssertionFailure() << kVainFrames << " frames were sent in vain";
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult ThreeHosts::wait_for_sent(std::size_t count) {
  const std::size_t wanted = sent_.size() + count;
  return wait_for([&] { return sent_.size() >= wanted; });
}

::testing::AssertionResult ThreeHosts::wait_for_silence() {
  std::size_t poses = poses_.size(), sent = sent_.size();
  return wait_for([&] {
    if (poses_.size() != poses) {
      poses = poses_.size();
      sent = sent_.size();
    }
    return sent_.size() >= sent + kSilentFrames;
  });
}

::testing::AssertionResult ThreeHosts::poses_resume(const std::string& cause, std::size_t count) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end_of_cause = Clock::now();
  const std::size_t sent = sent_.size();
  std::size_t before = poses_.size();
  // Poses of earlier frames may still be on their way.
  const auto of_a_later_frame = [&](const body_poses_t& poses) {
    return std::find(sent_.begin() + sent, sent_.end(), poses.stamp.utime) != sent_.end();
  };
  auto result = wait_for([&] {
    while (before < poses_.size() && !of_a_later_frame(poses_[before])) ++before;
    return before < poses_.size();
  });
  const std::chrono::duration<double> elapsed = Clock::now() - end_of_cause;
  std::printf("poses came %.2f s after: %s\n", elapsed.count(), cause.c_str());
  return result ? wait_for([&] { return poses_.size() >= before + count; }) : result;
}

::testing::AssertionResult ThreeHosts::wait_for_status(
    const std::string& module, const std::function<bool(const module_status_t&)>& told) {
  return wait_for([&] { return status_.count(module) > 0 && told(status_[module]); });
}

RunResult ThreeHosts::run_on(const std::string& host, const std::string& name) const {
  return run(network_->on_host(host, {program(name), std::string("--lcm-url=") + kUrl}));
}

int ThreeHosts::stop_logger_and_replay() {
  stop("lcm-logger", SIGTERM);
  const std::string out = folder_ + "/replayed.log";
  const RunResult result = run({program("limbcast-replay"), log_, out,
                                std::string("--reconstructor.image-scale=") + kImageScale});
  EXPECT_EQ(result.exit_code, 0) << result.output;
  int frames = 0;
  for (const lcm_io::LogEvent& event : replay::on_channel(replay::events_of(out), "BODY_POSES")) {
    check_poses(lcm_io::decode<body_poses_t>(event.data));
    ++frames;
  }
  return frames;
}

}  // namespace limbcast::test
