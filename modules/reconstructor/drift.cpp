#include "modules/reconstructor/drift.hpp"

#include <cmath>
#include <cstdlib>

#include "common/median.hpp"
#include "modules/reconstructor/row_differences.hpp"

namespace limbcast::reconstructor {

void RecentMedian::add(double value) {
  values_.push_back(value);
  if (values_.size() > params_.num_measurements) values_.pop_front();
}

std::optional<double> RecentMedian::value() const {
  if (values_.size() < params_.min_measurements) return std::nullopt;
  return median(std::vector<double>(values_.begin(), values_.end()));
}

DriftMonitor::DriftMonitor(const DriftParams& params)
    : params_(params), rows_px_(params), offsets_px_(params), leans_deg_(params) {}

bool DriftMonitor::is_due(std::int64_t utime) const {
  // The times of a recording that is played again jump back.
  return !last_utime_ || std::abs(utime - *last_utime_) >= params_.period_us;
}

void DriftMonitor::add(std::int64_t utime, std::vector<double> row_differences_px,
                       const std::optional<GroundLean>& ground) {
  last_utime_ = utime;
  if (static_cast<int>(row_differences_px.size()) >= params_.min_corners)
    rows_px_.add(median_size_px(std::move(row_differences_px)));
  if (!ground) return;
  offsets_px_.add(ground->offset_px);
  leans_deg_.add(ground->lean_deg);
}

std::optional<double> DriftMonitor::drift_px() const {
  const std::optional<double> difference_px = row_difference_px();
  if (!difference_px || *difference_px <= params_.max_row_difference_px) return std::nullopt;
  return difference_px;
}

std::optional<GroundLean> DriftMonitor::lean() const {
  const std::optional<double> lean_deg = leans_deg_.value();
  if (!lean_deg || std::abs(*lean_deg) <= params_.max_lean_deg) return std::nullopt;
  return GroundLean{*offsets_px_.value(), *lean_deg};
}

}  // namespace limbcast::reconstructor
