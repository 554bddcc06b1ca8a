#include "modules/reconstructor/drift.hpp"

#include <cstdlib>

#include "common/median.hpp"
#include "modules/reconstructor/row_differences.hpp"

namespace limbcast::reconstructor {

bool DriftMonitor::is_due(std::int64_t utime) const {
  // The times of a recording that is played again jump back.
  return !last_utime_ || std::abs(utime - *last_utime_) >= params_.period_us;
}

void DriftMonitor::add(std::int64_t utime, std::vector<double> row_differences_px) {
  last_utime_ = utime;
  if (static_cast<int>(row_differences_px.size()) < params_.min_corners) return;
  measurements_px_.push_back(median_size_px(std::move(row_differences_px)));
  if (measurements_px_.size() > params_.num_measurements) measurements_px_.pop_front();
}

std::optional<double> DriftMonitor::row_difference_px() const {
  if (measurements_px_.size() < params_.min_measurements) return std::nullopt;
  return median(std::vector<double>(measurements_px_.begin(), measurements_px_.end()));
}

std::optional<double> DriftMonitor::drift_px() const {
  const std::optional<double> difference_px = row_difference_px();
  if (!difference_px || *difference_px <= params_.max_row_difference_px) return std::nullopt;
  return difference_px;
}

}  // namespace limbcast::reconstructor
