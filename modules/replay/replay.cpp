#include "modules/replay/replay.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <set>

#include "common/config/log.hpp"
#include "common/config/output_file.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/message_error.hpp"
#include "common/lcm_io/module.hpp"
#include "common/lcm_io/whole_log.hpp"
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
    lcm_io::WholeLog log(options_.out);
    OrderedWorkers<FrameResult> workers(options_.threads);
    const std::size_t max_pending = kPendingPerThread * static_cast<std::size_t>(options_.threads);
    std::optional<LogEvent> event;
    while ((event = reader.next()) && !lcm_io::stop_requested()) {
      take_in(std::move(*event), workers);
      while (workers.pending() > max_pending || oldest_is_ready())
        write_oldest(workers, log.writer(), progress);
    }
    while (!waiting_.empty() && !lcm_io::stop_requested())
      write_oldest(workers, log.writer(), progress);
    finish(log, reader.at_end() && waiting_.empty() && !left_a_frame_);
    summary_.torn_bytes = reader.torn_bytes();
    summary_.damaged_bytes = reader.damaged_bytes();
    return summary_;
  }

 private:
  /// Told to end after its last event it has nothing left to do.
  void finish(lcm_io::WholeLog& log, bool is_whole) {
    if (is_whole) return log.finish();
    log.close();
    summary_.left_by_interrupt = log.what_is_left("replayed");
  }

  /// An event of IN and whether results follow it.
  struct Waiting {
    LogEvent event;
    bool is_frame;
  };

  bool oldest_is_ready() const { return !waiting_.empty() && !waiting_.front().is_frame; }

  /// First pass: where the chain begins for each sensor, and its first calibration.
  void survey() {
    std::map<std::pair<std::string, Level>, std::set<std::int64_t>> frames;
    std::set<std::string> stereo_cameras;
    lcm_io::LogReader reader(options_.in);
    while (const auto event = reader.next()) {
      if (chain_.is_calibration(event->channel)) chain_.on_first_calibration(*event);
      const auto level = chain_.level_of(event->channel);
      if (!level || !may_begin(*level)) continue;
      const auto frame = chain_.frame_of(*event);
      if (!frame) continue;
      frames[{frame->sensor, *level}].insert(frame->utime);
      if (chain_.needs_calibration(event->channel)) stereo_cameras.insert(frame->sensor);
    }
    // The map's order is by sensor, then level: the last entry of a sensor that is taken is its
    // first level.
    for (auto entry = frames.rbegin(); entry != frames.rend(); ++entry) {
      const auto& [sensor, level] = entry->first;
      const bool has_later = contents_.first_level.count(sensor) > 0;
      if (level == Level::kImages && has_later && stereo_cameras.count(sensor) > 0 &&
          !chain_.has_calibration(sensor)) {
        summary_.uncalibrated.push_back(sensor);
        continue;
      }
      contents_.first_level[sensor] = level;
    }
    for (const auto& [sensor, level] : contents_.first_level)
      contents_.frames += static_cast<int>(frames.at({sensor, level}).size());
    if (contents_.frames == 0)
      throw UsageError(
          (reader.torn_bytes() > 0
               ? lcm_io::torn_end(options_.in, reader.torn_bytes()) + "; what is left"
               : options_.in + ":") +
          " holds no images, clouds or segments (with --tracker: poses) to begin with; "
          "see --from and the options of channels");
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
    const bool is_frame = begins_chain(event) && !was_taken(event);
    if (!is_frame && is_stale(event)) return;
    if (is_frame) workers.add(chain_.prepare(event));
    waiting_.push_back({std::move(event), is_frame});
  }

  std::optional<Level> first_level_of(const LogEvent& event) const {
    const auto frame = chain_.frame_of(event);
    if (!frame) return std::nullopt;
    const auto known = contents_.first_level.find(frame->sensor);
    if (known == contents_.first_level.end()) return std::nullopt;
    return known->second;
  }

  bool begins_chain(const LogEvent& event) const {
    const auto level = chain_.level_of(event.channel);
    if (!level || !may_begin(*level)) return false;
    // A malformed message goes through the chain as a frame, which names what is wrong with it. The
    // first frames of a sensor that a logger has written since the first pass do not.
    return !chain_.frame_of(event) || first_level_of(event) == level;
  }

  /// A frame that the log holds twice, as two hosts heard it, is worked on once.
  bool was_taken(const LogEvent& event) {
    const auto frame = chain_.frame_of(event);
    return frame && !taken_.insert(*frame).second;
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
    if (!oldest.is_frame) return writer.write(oldest.event);
    const FrameResult result = workers.take();
    // Who stops the program waits for a step of a frame at most: what is left of it is not done,
    // and such a frame is not written.
    if (lcm_io::stop_requested()) {
      left_a_frame_ = true;
      return;
    }
    writer.write(oldest.event);
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
      if (tracked)
        writer.write(event.utime, channels_.tracked_poses_channel, *tracked);
      else
        ++summary_.untracked;
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
  bool left_a_frame_ = false;  ///< in work when the program was told to end
  std::set<Frame> taken_;
};

void check_levels(const ReplayOptions& options) {
  if (options.from == Level::kPoses && !options.track)
    throw UsageError("--from poses needs --tracker: nothing else is made from poses");
}

}  // namespace

ReplaySummary replay(const ReplayOptions& options, const ChainOptions& chain,
                     const Progress& progress) {
  check_levels(options);
  config::check_output_file("OUT.log", options.out, {options.in});
  // Frames are worked on side by side, so that threads within a frame would only get in each
  // other's way.
  const tbb::global_control one_thread_a_frame(tbb::global_control::max_allowed_parallelism, 1);
  cv::setNumThreads(1);
  return Replay(options, chain).run(progress);
}

}  // namespace limbcast::replay
