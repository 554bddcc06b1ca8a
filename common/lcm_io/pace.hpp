#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>

namespace limbcast::lcm_io {

/// Whether a stage should take up another frame, by which of its results the stage after it has
/// answered. A stage that is faster than the next one works for nothing: the next one takes the
/// newest result and skips the others, and on few cores what they cost is missing there.
///
/// One result may lie ready while another is worked on, so that the next stage never waits. Where
/// nobody answers, results are made as fast as frames come. Knows no clock: it is told the time.
class Pace {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Who has not answered for so long is not there, or lost what was sent.
  static constexpr std::chrono::milliseconds kPatience{1000};

  /// The result for that frame went out.
  void published(const std::string& sensor, std::int64_t frame_utime, Time now);
  /// The next stage is done with that frame, and with all that were sent before: those it skipped.
  void answered(const std::string& sensor, std::int64_t frame_utime);
  bool may_go_on(Time now);

 private:
  struct Result {
    std::string sensor;
    std::int64_t frame_utime;
    Time published;
  };
  std::deque<Result> unanswered_;
  bool answers_ = false;  ///< somebody does
};

}  // namespace limbcast::lcm_io
