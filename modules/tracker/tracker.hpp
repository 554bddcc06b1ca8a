#pragma once

#include <optional>
#include <vector>

#include "modules/tracker/person_track.hpp"

namespace limbcast::tracker {

/// Follows the people whom one sensor sees: who is who, smoothed, predicted through short gaps.
class Tracker {
 public:
  explicit Tracker(const TrackerParams& params = {}) : params_(params) {}

  /// The next frame of the sensor, with identities that stay, the oldest first. Nothing for a frame
  /// that is not later than the one before: what was told cannot be changed. After a jump of the
  /// clock, back or forward, by more than the time after which people are forgotten all are new.
  std::optional<BodyPoses> track(const BodyPoses& measured);

 private:
  void begin_frame(double elapsed_s);
  std::vector<bool> update_known(const BodyPoses& measured);
  void begin_new(const BodyPoses& measured, const std::vector<bool>& known);

  TrackerParams params_;
  std::vector<PersonTrack> tracks_;
  std::optional<std::int64_t> last_utime_;
  std::int32_t last_id_ = 0;
};

}  // namespace limbcast::tracker
