#include "modules/replay/replay.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/core/utility.hpp>

#include "common/config/log.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/message_error.hpp"
#include "common/lcm_io/module.hpp"
#include "modules/replay/ordered_workers.hpp"

namespace limbcast::replay {
namespace {

using config::UsageError;
using lcm_io::LogEvent;

/// Frames in work or waiting to be written for each thread: keeps the threads busy beside a slow
/// frame.
constexpr std::size_t kPendingPerThread = 4;

/// What the first pass through a log tells.
struct Contents {
  std::map<std::string, Level> first_level;  ///< where the chain begins for each sensor
  int frames = 0;                            ///< messages that the chain begins with
};

class Replay {
 public:
  Replay(const ReplayOptions& options, const ChainOptions& chain)
      : options_(options), chain_(chain), channels_(chain.tracker) {
    if (options.track) tracker_.emplace(chain.tracker);
  }

  ReplaySummary run(const Progress& progress) {
    survey();
    lcm_io::LogReader reader(options_.in);
    lcm_io::LogWriter writer(options_.out);
    OrderedWorkers<FrameResult> workers(options_.threads);
    const std::size_t max_pending = kPendingPerThread * static_cast<std::size_t>(options_.threads);
    while (!lcm_io::stop_requested()) {
      std::optional<LogEvent> event = reader.next();
      if (!event) break;
      take_in(std::move(*event), workers);
      while (workers.pending() > max_pending || oldest_is_ready())
        write_oldest(workers, writer, progress);
    }
    while (!waiting_.empty()) write_oldest(workers, writer, progress);
    writer.close();
    summary_.interrupted = lcm_io::stop_requested();
    summary_.torn_bytes = reader.torn_bytes();
    summary_.damaged_bytes = reader.damaged_bytes();
    return summary_;
  }

 private:
  /// An event of IN and whether results follow it.
  struct Waiting {
    LogEvent event;
    bool is_frame;
  };

  bool oldest_is_ready() const { return !waiting_.empty() && !waiting_.front().is_frame; }

  /// First pass: where the chain begins for each sensor, and its first calibration.
  void survey() {
    std::map<std::pair<std::string, Level>, int> counts;
    lcm_io::LogReader reader(options_.in);
    while (const auto event = reader.next()) {
      if (chain_.is_calibration(event->channel)) chain_.on_first_calibration(*event);
      const auto level = chain_.level_of(event->channel);
      if (!level || !may_begin(*level)) continue;
      if (const auto sensor = chain_.sensor_of(*event)) ++counts[{*sensor, *level}];
    }
    // The map's order is by sensor, then level: the first entry of a sensor is its first level.
    for (const auto& [key, count] : counts) {
      if (contents_.first_level.emplace(key.first, key.second).second) contents_.frames += count;
    }
    if (contents_.frames == 0)
      throw UsageError(options_.in +
                       ": holds no images, clouds or segments to begin with; see --from and the "
                       "options of channels");
  }

  bool may_begin(Level level) const {
    return level >= options_.from && (level != Level::kPoses || options_.track);
  }

  void take_calibration(const LogEvent& event) {
    try {
      chain_.on_calibration(event);
    } catch (const lcm_io::MessageError& error) {
      if (summary_.malformed++ == 0) summary_.first_malformed = event.channel + ": " + error.what();
    } catch (const std::exception& error) {
      if (summary_.failed++ == 0) summary_.first_failure = event.channel + ": " + error.what();
    }
  }

  void take_in(LogEvent event, OrderedWorkers<FrameResult>& workers) {
    if (chain_.is_calibration(event.channel)) take_calibration(event);
    const bool is_frame = begins_chain(event);
    if (!is_frame && is_stale(event)) return;
    if (is_frame) workers.add(chain_.prepare(event));
    waiting_.push_back({std::move(event), is_frame});
  }

  std::optional<Level> first_level_of(const LogEvent& event) const {
    const auto sensor = chain_.sensor_of(event);
    if (!sensor) return std::nullopt;
    const auto known = contents_.first_level.find(*sensor);
    if (known == contents_.first_level.end()) return std::nullopt;
    return known->second;
  }

  bool begins_chain(const LogEvent& event) const {
    const auto level = chain_.level_of(event.channel);
    if (!level || !may_begin(*level)) return false;
    const auto sensor = chain_.sensor_of(event);
    // A malformed message goes through the chain as a frame, which names what is wrong with it.
    return !sensor || contents_.first_level.at(*sensor) == *level;
  }

  bool is_stale(const LogEvent& event) const {
    if (event.channel == lcm_io::kStatusChannel || event.channel == channels_.tracked_poses_channel)
      return true;
    const auto level = chain_.level_of(event.channel);
    if (!level || *level < options_.from) return false;
    const auto first = first_level_of(event);
    return first && *level > *first;
  }

  /// Writes the oldest waiting event, with its results where it is a frame.
  void write_oldest(OrderedWorkers<FrameResult>& workers, lcm_io::LogWriter& writer,
                    const Progress& progress) {
    const Waiting oldest = std::move(waiting_.front());
    waiting_.pop_front();
    writer.write(oldest.event);
    if (!oldest.is_frame) return;
    const FrameResult result = workers.take();
    for (const LogEvent& event : result.events) writer.write(event);
    write_tracked(result.events.empty() ? oldest.event : result.events.back(), writer);
    count(oldest.event, result);
    progress(summary_.frames, contents_.frames);
  }

  /// Follows people from the last event of a frame, where that holds poses. What is malformed was
  /// counted before.
  void write_tracked(const LogEvent& event, lcm_io::LogWriter& writer) {
    if (!tracker_ || event.channel != channels_.body_poses_channel) return;
    try {
      const auto tracked = tracker_->process(lcm_io::decode<body_poses_t>(event.data));
      if (tracked) writer.write(event.utime, channels_.tracked_poses_channel, *tracked);
    } catch (const lcm_io::MessageError&) {
    }
  }

  void count(const LogEvent& event, const FrameResult& result) {
    const std::string where = event.channel + " at " + std::to_string(event.utime) + ": ";
    if (!result.malformed.empty()) {
      if (summary_.malformed++ == 0) summary_.first_malformed = where + result.malformed;
      return;
    }
    ++summary_.frames;
    summary_.persons += result.persons;
    if (!result.failure.empty() && summary_.failed++ == 0)
      summary_.first_failure = where + result.failure;
  }

  ReplayOptions options_;
  Chain chain_;
  tracker::StageOptions channels_;
  std::optional<tracker::Stage> tracker_;
  Contents contents_;
  ReplaySummary summary_;
  std::deque<Waiting> waiting_;
};

void check_files(const ReplayOptions& options) {
  std::error_code error;
  if (std::filesystem::equivalent(options.in, options.out, error))
    throw UsageError(options.out + ": is the log that is replayed; give another OUT.log");
}

void check_levels(const ReplayOptions& options) {
  if (options.from == Level::kPoses && !options.track)
    throw UsageError("--from poses needs --tracker: nothing else is made from poses");
}

}  // namespace

ReplaySummary replay(const ReplayOptions& options, const ChainOptions& chain,
                     const Progress& progress) {
  check_levels(options);
  check_files(options);
  // Frames are worked on side by side, so that threads within a frame would only get in each
  // other's way.
  const tbb::global_control one_thread_a_frame(tbb::global_control::max_allowed_parallelism, 1);
  cv::setNumThreads(1);
  return Replay(options, chain).run(progress);
}

}  // namespace limbcast::replay
