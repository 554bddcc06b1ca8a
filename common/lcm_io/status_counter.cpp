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

bool StatusCounter::received(const std::string& sensor, std::int64_t sequence) {
  Sequence& numbers = sequences_.get(sensor);
  if (numbers.missing.erase(sequence) > 0) {
    --num_gaps_;
    ++num_late_;
    return false;
  }
  ++num_received_;
  ++period_received_;
  if (numbers.last && sequence > *numbers.last) {
    count_gap(numbers, *numbers.last, sequence);
  } else {
    // A number that goes back but was not missed is a source that was started again, not a loss.
    numbers.missing.clear();
  }
  numbers.last = sequence;
  return true;
}

void StatusCounter::count_gap(Sequence& numbers, std::int64_t last, std::int64_t next) {
  // Packets overtake one another within milliseconds; what is missing for longer is lost.
  constexpr std::uint64_t kLatestFrames = 16;
  // An hour's frames: who counts on from there is another source.
  constexpr std::uint64_t kMostLost = 100'000;
  // Any number may stand in a message, so that only unsigned differences are sure not to overflow.
  const auto steps_back = [next](std::int64_t sequence) {
    return static_cast<std::uint64_t>(next) - static_cast<std::uint64_t>(sequence);
  };
  const std::uint64_t step = steps_back(last);
  if (step > kMostLost) {
    numbers.missing.clear();
    return;
  }
  num_gaps_ += static_cast<std::int64_t>(step) - 1;
  while (!numbers.missing.empty() && steps_back(*numbers.missing.begin()) > kLatestFrames)
    numbers.missing.erase(numbers.missing.begin());
  const auto num_missing = static_cast<std::int64_t>(std::min(step - 1, kLatestFrames));
  for (std::int64_t i = num_missing; i > 0; --i) numbers.missing.insert(next - i);
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
