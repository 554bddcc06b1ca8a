#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "modules/log/channel_filter.hpp"

namespace limbcast::logs {

/// The frames of one sensor on one channel.
struct SensorInfo {
  std::int64_t frames = 0;
  std::int64_t lost = 0;      ///< sequence numbers that never came
  std::int64_t repeated = 0;  ///< frames with the number of the one before
  std::int64_t restarts = 0;  ///< the number went back: the source was started again
  std::int64_t last_sequence = 0;
};

struct ChannelInfo {
  std::string type;  ///< "point_cloud_t", or the fingerprint of a foreign type
  bool foreign = false;
  bool several_types = false;
  std::int64_t messages = 0, bytes = 0, malformed = 0;
  std::string first_malformed;
  std::int64_t first_utime = 0, last_utime = 0, longest_gap_us = 0;
  std::map<std::string, SensorInfo> sensors;

  /// Messages a second between the first and the last; 0 for a single one.
  double rate_hz() const;
};

/// One stereo or depth camera as its calibration describes it.
struct CameraInfo {
  int width = 0, height = 0;
  double focal_px = 0.0;
  double baseline_m = 0.0;  ///< 0: a depth camera
  bool has_gravity = false;
  std::int64_t changes = 0;  ///< how often another calibration followed
  std::vector<std::uint8_t> last_bytes;
};

/// A module as its last status tells.
struct ModuleInfo {
  std::string host, module, version, state, last_error;
  int pid = 0;
  std::int64_t received = 0, published = 0, lost = 0, skipped = 0, malformed = 0;
};

/// What a log holds.
struct LogInfo {
  std::string path;
  std::int64_t size_bytes = 0, events = 0;
  std::int64_t first_utime = 0, last_utime = 0;    ///< earliest and latest event
  std::int64_t first_number = 0, last_number = 0;  ///< of the first and the last event
  std::int64_t missing_numbers = 0;                ///< between them: cut out, or lost by the logger
  std::int64_t backward_steps = 0;                 ///< events with a time before the one ahead
  std::int64_t torn_bytes = 0, damaged_bytes = 0;
  std::map<std::string, ChannelInfo> channels;
  std::map<std::string, CameraInfo> cameras;  ///< by sensor
  std::vector<ModuleInfo> modules;            ///< by host, module, pid

  double duration_s() const;
};

/// Reads a log from begin to end. Throws config::UsageError where it is none.
LogInfo read_info(const std::string& path, const ChannelFilter& filter = ChannelFilter());

/// For people, in the manner of `rosbag info`.
std::string info_text(const LogInfo& info);
/// For programs.
std::string info_json(const LogInfo& info);

}  // namespace limbcast::logs
