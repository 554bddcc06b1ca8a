// Runs the camera process, reconstructor, segmenter and pose fitter on a recording and prints rate,
// latency from capture to pose, losses and memory.
//   chain_benchmark [--source LOG] [--rate HZ] [--seconds S] [--method paper|refined]

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/module_status_t.hpp>
#include <map>
#include <memory>
#include <sstream>

#include "common/config/options.hpp"
#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/module.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast {
namespace {

struct Settings {
  std::string source = test::repository_file("logs/demo.log");
  std::string method = "refined";
  double rate_hz = 10.0;
  double seconds = 20.0;
};

/// Largest memory a process has held so far [MB].
double peak_memory_mb(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  std::string key;
  constexpr double kKilobytesPerMegabyte = 1024.0;
  while (status >> key) {
    double kilobytes = 0.0;
    if (key == "VmHWM:" && status >> kilobytes) return kilobytes / kKilobytesPerMegabyte;
    status.ignore(1000, '\n');
  }
  return 0.0;
}

double percentile(const std::vector<double>& sorted, double share) {
  return sorted.empty()
             ? 0.0
             : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

class Chain {
 public:
  explicit Chain(const Settings& settings)
      : settings_(settings), folder_(test::temporary_folder("chain")) {
    start("reconstructor", {});
    start("segmenter", {});
    start("pose-fitter", {"--method", settings.method});
  }
  void start_camera() {
    start("stereo-camera", {"--source", settings_.source, "--rate",
                            std::to_string(settings_.rate_hz), "--loop", "--restamp"});
  }
  const std::string& url() const { return url_; }
  void print_memory() const {
    for (const auto& [name, process] : processes_)
      std::printf("%-14s peak memory %6.1f MB\n", name.c_str(), peak_memory_mb(process->pid()));
  }

 private:
  void start(const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(), {test::program("limbcast-" + name), "--lcm-url", url_});
    processes_[name] = std::make_unique<test::ChildProcess>(options, folder_ + "/" + name + ".txt");
  }

  Settings settings_;
  std::string url_ = test::private_lcm_url(), folder_;
  std::map<std::string, std::unique_ptr<test::ChildProcess>> processes_;
};

void run(int argc, const char* const* argv) {
  Settings settings;
  config::Section section("benchmark");
  section.add("source", settings.source, "LCM log with stereo images");
  section.add_choice("method", settings.method, {"paper", "refined"}, "method of the pose fitter");
  section.add("rate", settings.rate_hz, "frames/s", "rate of the camera", {0.1, 1000.0});
  section.add("seconds", settings.seconds, "s", "how long", {1.0, 3600.0});
  config::Parser parser("chain_benchmark", "rate and latency of the four processes");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;

  Chain chain(settings);
  lcm_io::Bus bus(chain.url());
  std::map<std::string, module_status_t> statuses;
  std::vector<double> latencies_ms;
  bus.subscribe<module_status_t>(
      "MODULE_STATUS", lcm_io::Keep::kAll,
      [&](const module_status_t& status) { statuses[status.module] = status; });
  bus.subscribe<body_poses_t>("BODY_POSES", lcm_io::Keep::kAll, [&](const body_poses_t& poses) {
    constexpr double kMicrosecondsPerMillisecond = 1000.0;
    latencies_ms.push_back(static_cast<double>(lcm_io::utime_now() - poses.stamp.utime) /
                           kMicrosecondsPerMillisecond);
  });
  constexpr std::chrono::milliseconds kWait{50};
  while (statuses.size() < 3) bus.handle(kWait);
  chain.start_camera();
  while (latencies_ms.empty()) bus.handle(kWait);
  latencies_ms.clear();  // the first frame waits for the calibration
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  while (elapsed_s() < settings.seconds) bus.handle(kWait);

  const double duration_s = elapsed_s();
  std::sort(latencies_ms.begin(), latencies_ms.end());
  std::printf(
      "method %s, camera %.1f frames/s: poses %.1f frames/s, capture to pose p50 %.1f, p90 %.1f, "
      "p99 %.1f ms\n",
      settings.method.c_str(), settings.rate_hz,
      static_cast<double>(latencies_ms.size()) / duration_s, percentile(latencies_ms, 0.5),
      percentile(latencies_ms, 0.9), percentile(latencies_ms, 0.99));
  for (const auto& [name, status] : statuses)
    std::printf("%-14s received %lld, skipped %lld, lost %lld\n", name.c_str(),
                static_cast<long long>(status.num_received),
                static_cast<long long>(status.num_skipped),
                static_cast<long long>(status.num_lost));
  chain.print_memory();
}

}  // namespace
}  // namespace limbcast

int main(int argc, char** argv) {
  return limbcast::config::run_program("chain_benchmark", [&] { limbcast::run(argc, argv); });
}
