#include "common/lcm_io/pace.hpp"

#include <algorithm>

namespace limbcast::lcm_io {
namespace {

/// Worked on, and ready for when that is done.
constexpr std::size_t kMostUnanswered = 2;
/// Of what nobody answers so many are remembered: the first answer must find its frame.
constexpr std::size_t kMostRemembered = 100;

}  // namespace

void Pace::published(const std::string& sensor, std::int64_t frame_utime, Time now) {
  unanswered_.push_back({sensor, frame_utime, now});
  if (unanswered_.size() > kMostRemembered) unanswered_.pop_front();
}

void Pace::answered(const std::string& sensor, std::int64_t frame_utime) {
  const auto result =
      std::find_if(unanswered_.begin(), unanswered_.end(), [&](const Result& other) {
        return other.frame_utime == frame_utime && other.sensor == sensor;
      });
  if (result == unanswered_.end()) return;
  unanswered_.erase(unanswered_.begin(), result + 1);
  answers_ = true;
}

bool Pace::may_go_on(Time now) {
  if (answers_ && !unanswered_.empty() && now - unanswered_.front().published > kPatience)
    answers_ = false;
  return !answers_ || unanswered_.size() < kMostUnanswered;
}

}  // namespace limbcast::lcm_io
