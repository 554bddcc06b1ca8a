#include "common/lcm_io/status_counter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limbcast::lcm_io {
namespace {

/// The value below which `share` of the sorted values lie (nearest rank).
float percentile(const std::vector<float>& sorted, double share) {
  if (sorted.empty()) return std::numeric_limits<float>::quiet_NaN();
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

}  // namespace

void StatusCounter::received(const std::string& sensor, std::int64_t sequence) {
  ++num_received_;
  ++period_received_;
  const auto last = last_sequence_.find(sensor);
  // A number that goes back is a source that was started again, not a loss.
  if (last != last_sequence_.end() && sequence > last->second + 1)
    num_gaps_ += sequence - last->second - 1;
  last_sequence_[sensor] = sequence;
}

void StatusCounter::published(std::int64_t frame_utime, std::int64_t now_utime) {
  constexpr float kMicrosecondsPerMillisecond = 1000.0F;
  ++num_published_;
  period_latencies_ms_.push_back(static_cast<float>(now_utime - frame_utime) /
                                 kMicrosecondsPerMillisecond);
}

void StatusCounter::malformed(const std::string& reason) {
  ++num_malformed_;
  last_error_ = reason;
}

void StatusCounter::failed(const std::string& reason) {
  period_failed_ = true;
  last_error_ = reason;
}

StatusCounter::Period StatusCounter::finish_period(double duration_s) {
  std::sort(period_latencies_ms_.begin(), period_latencies_ms_.end());
  Period period;
  period.rate_in_hz = static_cast<float>(static_cast<double>(period_received_) / duration_s);
  period.rate_out_hz =
      static_cast<float>(static_cast<double>(period_latencies_ms_.size()) / duration_s);
  period.latency_p50_ms = percentile(period_latencies_ms_, 0.50);
  period.latency_p99_ms = percentile(period_latencies_ms_, 0.99);
  period.latency_max_ms = percentile(period_latencies_ms_, 1.0);
  period.failing = period_failed_;
  period_received_ = 0;
  period_failed_ = false;
  period_latencies_ms_.clear();
  return period;
}

}  // namespace limbcast::lcm_io
