#pragma once

#include <string>
#include <vector>

#include "modules/log/channel_filter.hpp"

namespace limbcast::logs {

/// Which part of a log is kept; all conditions must hold.
struct CutOptions {
  std::string in, out;
  /// Seconds after the first event; < 0: no limit. Where the clock was set back, events are earlier
  /// than the first.
  double from_s = -1.0, to_s = -1.0;
  /// Frames (different times of capture), from 0, in the order in which they first come, both kept;
  /// to_frame < 0: to the last. What belongs to no frame is kept where its time is theirs.
  int from_frame = 0, to_frame = -1;
  ChannelFilter channels;
  /// Keep each stereo camera's last calibration before the part, so that the part can be replayed.
  bool keep_calibration = true;
};

/// What was read and what was kept.
struct CopySummary {
  std::int64_t events_read = 0, events_kept = 0;
  std::int64_t torn_bytes = 0, damaged_bytes = 0;  ///< of what was read
};

/// Copies that part: bytes, times, numbers and order of the events stay. Throws config::UsageError
/// where IN is no log, OUT cannot be made or is IN, the part ends before it begins, or nothing
/// would be kept. OUT takes its place when it is whole (lcm_io::WholeLog): std::runtime_error where
/// the program is told to end before, or OUT cannot be written to its end.
CopySummary cut(const CutOptions& options);

struct MergeOptions {
  std::string out;
  std::vector<std::string> in;
  /// A message that several logs hold is kept once: loggers on several hosts heard it.
  bool drop_doubles = false;
};

/// All events of several logs by their times; of one log in its order. Numbers count anew, as those
/// of several logs are not one count.
CopySummary merge(const MergeOptions& options);

}  // namespace limbcast::logs
