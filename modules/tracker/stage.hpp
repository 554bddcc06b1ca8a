#pragma once

#include <limbcast/body_poses_t.hpp>
#include <optional>
#include <string>

#include "common/bounded_map.hpp"
#include "common/config/options.hpp"
#include "modules/tracker/tracker.hpp"

namespace limbcast::tracker {

struct StageOptions {
  TrackerParams algorithm;
  std::string body_poses_channel = "BODY_POSES";
  std::string tracked_poses_channel = "TRACKED_POSES";
};

/// Binds the keys of section [tracker].
void declare(config::Section& section, StageOptions& options);

/// From messages to messages: the one wiring of the tracker, for the process and for
/// limbcast-replay. Each sensor has people of its own, as nobody tells how sensors stand to one
/// another.
class Stage {
 public:
  explicit Stage(const StageOptions& options) : params_(options.algorithm) {}

  /// Nothing for a frame that comes after a later one of the same sensor.
  std::optional<body_poses_t> process(const body_poses_t& poses);

 private:
  TrackerParams params_;
  BoundedMap<Tracker> trackers_;  ///< by sensor
};

}  // namespace limbcast::tracker
