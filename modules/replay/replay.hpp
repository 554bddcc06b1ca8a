#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "modules/replay/chain.hpp"

namespace limbcast::replay {

struct ReplayOptions {
  std::string in, out;
  int threads = 1;
  /// Messages before this level are handed through, but nothing is made from them.
  Level from = Level::kImages;
  /// Follow people over time too: tracked poses after the poses.
  bool track = false;
};

struct ReplaySummary {
  int frames = 0, persons = 0;
  int malformed = 0, failed = 0;
  int untracked = 0;  ///< came after a later frame of their sensor: the tracker leaves them out
  std::string first_malformed, first_failure;
  std::int64_t torn_bytes = 0;     ///< of IN behind its last whole message
  std::int64_t damaged_bytes = 0;  ///< of IN between its messages
  /// Where what was replayed stands, if the program was told to end before the whole log was.
  std::string left_by_interrupt;
  /// Stereo cameras whose images have no calibration, so that their clouds or segments were taken.
  std::vector<std::string> uncalibrated;
};

/// Called now and then with frames done, frames in all.
using Progress = std::function<void(int done, int total)>;

/// Replays a log: every frame of every sensor goes through the chain from the first level that the
/// log holds for this sensor (from poses only where people are tracked). OUT holds what IN holds,
/// in its order and with its times, each frame followed by what was made from it, without what an
/// earlier run had made (clouds, segments, poses of the same sensor, tracked poses, status
/// messages). A frame that comes before its camera's calibration takes the first one that follows.
///
/// OUT takes its place when it is whole (lcm_io::WholeLog). Throws config::UsageError where IN
/// cannot be used or OUT cannot be made, std::runtime_error where it cannot be written to its end.
ReplaySummary replay(const ReplayOptions& options, const ChainOptions& chain,
                     const Progress& progress);

}  // namespace limbcast::replay
