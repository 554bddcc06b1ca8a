#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/bounded_map.hpp"

namespace limbcast::lcm_io {

/// Counts what a module receives, sends and loses. Knows no clock: every call is told the time.
class StatusCounter {
 public:
  /// A frame came in; a step of its sequence number beyond one is counted as gap (lost or skipped).
  /// False for a late frame, one that others overtook on the way: it fills its gap, and is older
  /// than what was worked on already.
  bool received(const std::string& sensor, std::int64_t sequence);
  /// The result for a frame captured at `frame_utime` went out at `now_utime`.
  void published(std::int64_t frame_utime, std::int64_t now_utime);
  void malformed(const std::string& reason);
  void failed(const std::string& reason);

  struct Period {
    float rate_in_hz = 0.0F, rate_out_hz = 0.0F;
    float latency_p50_ms = 0.0F, latency_p99_ms = 0.0F,
          latency_max_ms = 0.0F;  ///< NaN: nothing sent
    bool failing = false;
  };
  /// Figures since the last call, `duration_s` ago; starts a new period.
  Period finish_period(double duration_s);

  std::int64_t num_received() const { return num_received_; }
  std::int64_t num_published() const { return num_published_; }
  std::int64_t num_gaps() const { return num_gaps_; }
  std::int64_t num_late() const { return num_late_; }
  std::int64_t num_malformed() const { return num_malformed_; }
  const std::string& last_error() const { return last_error_; }

 private:
  struct Sequence {
    std::optional<std::int64_t> last;
    std::set<std::int64_t> missing;  ///< of the last few: what may still come
  };
  void count_gap(Sequence& sequence, std::int64_t last, std::int64_t next);

  std::int64_t num_received_ = 0, num_published_ = 0, num_gaps_ = 0, num_late_ = 0,
               num_malformed_ = 0;
  std::int64_t period_received_ = 0;
  bool period_failed_ = false;
  std::vector<float> period_latencies_ms_;
  BoundedMap<Sequence> sequences_;  ///< by sensor
  std::string last_error_;
};

}  // namespace limbcast::lcm_io
