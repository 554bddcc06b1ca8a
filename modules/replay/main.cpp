#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "common/config/log.hpp"
#include "common/config/options.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/module.hpp"
#include "modules/replay/replay.hpp"

namespace limbcast::replay {
namespace {

using config::log;
using config::LogLevel;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kProgressPeriod{1};

struct Options {
  ReplayOptions replay;
  ChainOptions chain;
  std::string from = "images";
};

void declare(config::Section& section, Options& options) {
  options.replay.threads = std::max(1U, std::thread::hardware_concurrency());
  section.add("threads", options.replay.threads, "",
              "frames worked on side by side; OUT is the same for any", {1, 256});
  section.add_choice("from", options.from, {"images", "clouds", "segments", "poses"},
                     "first messages to work on; what comes before is only handed through");
  section.add("tracker", options.replay.track, "follow people over time: adds tracked poses");
}

Level level_named(const std::string& name) {
  if (name == "clouds") return Level::kClouds;
  if (name == "segments") return Level::kSegments;
  if (name == "poses") return Level::kPoses;
  return Level::kImages;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string rate_text(int frames, double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f frames/s", seconds > 0.0 ? frames / seconds : 0.0);
  return text;
}

Progress shown_progress(Clock::time_point start) {
  return [start, last = start](int done, int total) mutable {
    if (Clock::now() - last < kProgressPeriod) return;
    last = Clock::now();
    log(LogLevel::kInfo, std::to_string(done) + " of " + std::to_string(total) + " frames, " +
                             rate_text(done, seconds_since(start)));
  };
}

void report(const ReplaySummary& summary, const std::string& in, double seconds) {
  if (summary.torn_bytes > 0) log(LogLevel::kWarning, lcm_io::torn_end(in, summary.torn_bytes));
  for (const std::string& sensor : summary.uncalibrated)
    log(LogLevel::kWarning, in + ": no calibration of stereo camera '" + sensor +
                                "'; began with what was made from its images");
  if (summary.damaged_bytes > 0)
    log(LogLevel::kWarning, in + ": is damaged, " + std::to_string(summary.damaged_bytes) +
                                " bytes between messages hold none and were left out");
  if (summary.malformed > 0)
    log(LogLevel::kWarning, std::to_string(summary.malformed) +
                                " malformed messages, nothing was made from them; the first: " +
                                summary.first_malformed);
  if (summary.untracked > 0)
    log(LogLevel::kWarning, std::to_string(summary.untracked) +
                                " frames came after a later one of their sensor and were not "
                                "tracked; was the clock set back?");
  log(LogLevel::kInfo, std::to_string(summary.frames) + " frames, " +
                           std::to_string(summary.persons) + " persons, " +
                           rate_text(summary.frames, seconds));
}

void run(int argc, const char* const* argv) {
  Options options;
  config::Section section("replay"), reconstructor("reconstructor"), segmenter("segmenter"),
      pose_fitter("pose_fitter"), tracker("tracker");
  declare(section, options);
  reconstructor::declare(reconstructor, options.chain.reconstructor);
  segmenter::declare(segmenter, options.chain.segmenter);
  pose_fitter::declare(pose_fitter, options.chain.pose_fitter);
  tracker::declare(tracker, options.chain.tracker);
  config::Parser parser(
      "limbcast-replay",
      "Runs the whole chain over a log in one process: the same log and options give "
      "the same OUT.log, byte for byte.");
  parser.add_positional("IN.log", options.replay.in, "log with images, clouds or segments");
  parser.add_positional("OUT.log", options.replay.out,
                        "what IN holds, with clouds, segments and poses");
  parser.add(section);
  for (config::Section* stage : {&reconstructor, &segmenter, &pose_fitter, &tracker})
    parser.add(*stage, false);
  if (!parser.parse(argc, argv)) return;
  options.replay.from = level_named(options.from);
  config::configure_log("replay", parser.common().log_level);
  lcm_io::install_signal_handlers();

  const Clock::time_point start = Clock::now();
  const ReplaySummary summary = replay(options.replay, options.chain, shown_progress(start));
  report(summary, options.replay.in, seconds_since(start));
  if (!summary.left_by_interrupt.empty())
    throw std::runtime_error("interrupted; " + summary.left_by_interrupt);
  if (summary.failed > 0)
    throw std::runtime_error(std::to_string(summary.failed) +
                             " frames could not be worked on; the first: " + summary.first_failure);
  if (summary.frames == 0)
    throw std::runtime_error(options.replay.in +
                             ": every frame is malformed, nothing was made from them; the first: " +
                             summary.first_malformed);
}

}  // namespace
}  // namespace limbcast::replay

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-replay",
                                       [&] { limbcast::replay::run(argc, argv); });
}
