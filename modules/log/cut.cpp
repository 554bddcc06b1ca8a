#include "modules/log/cut.hpp"

#include <algorithm>
#include <limbcast/stereo_calibration_t.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "common/config/options.hpp"
#include "common/config/output_file.hpp"
#include "common/formatted.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/whole_log.hpp"
#include "common/units.hpp"
#include "modules/log/message_types.hpp"
#include "modules/log/next_of.hpp"

namespace limbcast::logs {
namespace {

using lcm_io::LogEvent;

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

struct Span {
  std::int64_t from = kNever, to = -kNever;
  void take(std::int64_t value) {
    from = std::min(from, value);
    to = std::max(to, value);
  }
  bool holds(std::int64_t value) const { return value >= from && value <= to; }
};

/// Decides event by event; a first pass through the log finds the frames.
class Selection {
 public:
  explicit Selection(const CutOptions& options)
      : options_(options), by_frame_(options.from_frame > 0 || options.to_frame >= 0) {
    lcm_io::LogReader reader(options.in);
    while (const auto event = next_of(reader)) {
      if (begin_utime_ == kNever) begin_utime_ = event->utime;
      if (!by_frame_) break;
      const MessageSummary summary = summarize(*event);
      if (!summary.stamp) continue;
      frames_.emplace(summary.stamp->utime, static_cast<int>(frames_.size()));
      if (is_frame_kept(summary.stamp->utime)) frame_times_.take(event->utime);
    }
  }

  bool keeps(const LogEvent& event) const {
    return options_.channels.takes(event.channel) && is_in_time(event) && is_in_frames(event);
  }

 private:
  bool is_in_time(const LogEvent& event) const {
    const double after_s =
        static_cast<double>(event.utime - begin_utime_) / kMicrosecondsPerSecond<double>;
    return (options_.from_s < 0.0 || after_s >= options_.from_s) &&
           (options_.to_s < 0.0 || after_s <= options_.to_s);
  }

  bool is_in_frames(const LogEvent& event) const {
    if (!by_frame_) return true;
    const auto stamp = summarize(event).stamp;
    return stamp ? is_frame_kept(stamp->utime) : frame_times_.holds(event.utime);
  }

  /// What a logger has written since the first pass is no part of the log.
  bool is_frame_kept(std::int64_t frame_utime) const {
    const auto frame = frames_.find(frame_utime);
    return frame != frames_.end() && frame->second >= options_.from_frame &&
           (options_.to_frame < 0 || frame->second <= options_.to_frame);
  }

  const CutOptions& options_;
  bool by_frame_;
  std::int64_t begin_utime_ = kNever;
  std::map<std::int64_t, int> frames_;
  Span frame_times_;
};

/// The last calibration of each camera before the part that is kept.
class Calibrations {
 public:
  void remember(const LogEvent& event) {
    if (summarize(event).type != stereo_calibration_t::getTypeName()) return;
    try {
      const auto message = lcm_io::decode<stereo_calibration_t>(event.data);
      last_[{event.channel, message.sensor}] = event;
    } catch (const lcm_io::MessageError&) {
      // Nobody could use it.
    }
  }
  /// In the order of the log.
  std::vector<LogEvent> take() {
    std::vector<LogEvent> events;
    for (auto& [key, event] : last_) events.push_back(std::move(event));
    std::sort(events.begin(), events.end(),
              [](const LogEvent& a, const LogEvent& b) { return a.number < b.number; });
    last_.clear();
    return events;
  }

 private:
  std::map<std::pair<std::string, std::string>, LogEvent> last_;
};

void finish(lcm_io::WholeLog& out, bool interrupted, const std::string& reason_if_empty) {
  out.close();
  if (interrupted) throw std::runtime_error("interrupted; " + out.what_is_left("copied"));
  if (!out.begun()) throw config::UsageError(reason_if_empty);
  out.finish();
}

void add_losses(const lcm_io::LogReader& reader, CopySummary& summary) {
  summary.torn_bytes += reader.torn_bytes();
  summary.damaged_bytes += reader.damaged_bytes();
}

/// Tells messages apart by channel and bytes.
std::size_t key_of(const LogEvent& event) {
  const std::string bytes(event.data.begin(), event.data.end());
  return std::hash<std::string>()(event.channel + '\0' + bytes);
}

/// Keeps each message as often as the log that holds it most often.
class Doubles {
 public:
  bool is_double(const LogEvent& event, std::size_t log) {
    Count& count = counts_[key_of(event)];
    if (++count.seen[log] <= count.kept) return true;
    ++count.kept;
    return false;
  }

 private:
  struct Count {
    std::map<std::size_t, int> seen;  ///< by log
    int kept = 0;
  };
  std::map<std::size_t, Count> counts_;
};

/// A log and its next event.
struct Head {
  explicit Head(const std::string& path)
      : reader(std::make_unique<lcm_io::LogReader>(path)), event(reader->next()) {}
  std::unique_ptr<lcm_io::LogReader> reader;
  std::optional<LogEvent> event;
};

/// The head with the earliest event, the first of several; nothing at the end of all.
std::optional<std::size_t> earliest(const std::vector<Head>& heads) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < heads.size(); ++i) {
    if (!heads[i].event) continue;
    if (!found || heads[i].event->utime < heads[*found].event->utime) found = i;
  }
  return found;
}

void check_order(const CutOptions& options) {
  if (options.to_s >= 0.0 && options.from_s > options.to_s)
    throw config::UsageError(
        formatted("--from-s is %g, must not be after --to-s, %g", options.from_s, options.to_s));
  if (options.to_frame >= 0 && options.from_frame > options.to_frame)
    throw config::UsageError(formatted("--from-frame is %d, must not be after --to-frame, %d",
                                       options.from_frame, options.to_frame));
}

}  // namespace

CopySummary cut(const CutOptions& options) {
  config::check_output_file("OUT.log", options.out, {options.in});
  check_order(options);
  const Selection selection(options);
  Calibrations calibrations;
  CopySummary summary;
  lcm_io::LogReader reader(options.in);
  lcm_io::WholeLog out(options.out);
  while (const auto event = next_of(reader)) {
    ++summary.events_read;
    if (!selection.keeps(*event)) {
      const bool may_help = summary.events_kept == 0 && options.keep_calibration;
      if (may_help && options.channels.takes(event->channel)) calibrations.remember(*event);
      continue;
    }
    for (const LogEvent& calibration : calibrations.take()) {
      out.writer().copy(calibration);
      ++summary.events_kept;
    }
    out.writer().copy(*event);
    ++summary.events_kept;
  }
  add_losses(reader, summary);
  finish(out, !reader.at_end(),
         options.in + ": holds nothing of what shall be kept; limbcast-log info shows what it has");
  return summary;
}

CopySummary merge(const MergeOptions& options) {
  config::check_output_file("OUT.log", options.out, options.in);
  std::vector<Head> heads;
  for (const std::string& path : options.in) heads.emplace_back(path);
  Doubles doubles;
  CopySummary summary;
  lcm_io::WholeLog out(options.out);
  while (const auto next = earliest(heads)) {
    Head& head = heads[*next];
    ++summary.events_read;
    if (!options.drop_doubles || !doubles.is_double(*head.event, *next)) {
      out.writer().write(*head.event);
      ++summary.events_kept;
    }
    head.event = next_of(*head.reader);
  }
  for (const Head& head : heads) add_losses(*head.reader, summary);
  const bool interrupted = std::any_of(heads.begin(), heads.end(),
                                       [](const Head& head) { return !head.reader->at_end(); });
  finish(out, interrupted, options.in.front() + ": holds no whole event");
  return summary;
}

}  // namespace limbcast::logs
