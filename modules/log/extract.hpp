#pragma once

#include <cstdint>
#include <string>

#include "modules/log/channel_filter.hpp"

namespace limbcast::logs {

enum class Extracted { kImages, kClouds, kPoses };

struct ExtractOptions {
  std::string in, folder;
  Extracted what = Extracted::kImages;
  std::string sensor;  ///< only of this one; empty: of the only one
  std::string truth_channel = "GROUND_TRUTH";
  ChannelFilter channels;
};

struct ExtractSummary {
  std::int64_t frames = 0;     ///< written
  std::int64_t malformed = 0;  ///< messages left out
  std::int64_t torn_bytes = 0, damaged_bytes = 0;
};

/// Writes messages of a log as the folders that limbcast's sources read, each frame named by its
/// utime:
/// - images: NAME_left, NAME_right or NAME_color, NAME_depth (JPEG and PNG as they are in the log,
///   raw ones as PNG) and calibration.yml;
/// - clouds: NAME.pcd;
/// with timestamps.csv (gravity where a recording or an option told it) and, where the log has the
/// truth, NAME_gt.json;
/// - poses: CHANNEL.jsonl, lines as limbcast-export-poses writes them; what may not stand in a
///   file's name is '_'.
///
/// Throws config::UsageError where IN is no log, holds nothing of the kind, or images or clouds of
/// several sensors and none is chosen, and where the folder holds a recording; std::runtime_error
/// where a file cannot be written, or the program is told to end before the log does: then the
/// folder is a recording of the frames so far, and poses stand in CHANNEL.jsonl.unfinished.
ExtractSummary extract(const ExtractOptions& options);

}  // namespace limbcast::logs
