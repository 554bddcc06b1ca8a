#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/human_model/body_pose.hpp"

namespace limbcast::evaluate {

/// What was reported of each moment. Two sensors may take data at the same time.
class ReportedFrames {
 public:
  explicit ReportedFrames(const std::vector<BodyPoses>& frames) {
    for (const BodyPoses& frame : frames) {
      by_sensor_[{frame.stamp.sensor, frame.stamp.utime}] = &frame;
      by_time_[frame.stamp.utime] = &frame;
      sensors_.insert(frame.stamp.sensor);
    }
  }

  /// Null where nothing was reported. Truth in a folder names no sensor: there only the time tells.
  const BodyPoses* at(const Stamp& truth) const {
    if (sensors_.count(truth.sensor) > 0)
      return found_in(by_sensor_, std::pair(truth.sensor, truth.utime));
    return found_in(by_time_, truth.utime);
  }

 private:
  template <class Key>
  static const BodyPoses* found_in(const std::map<Key, const BodyPoses*>& frames, const Key& key) {
    const auto found = frames.find(key);
    return found == frames.end() ? nullptr : found->second;
  }

  std::map<std::pair<std::string, std::int64_t>, const BodyPoses*> by_sensor_;
  std::map<std::int64_t, const BodyPoses*> by_time_;
  std::set<std::string> sensors_;
};

}  // namespace limbcast::evaluate
