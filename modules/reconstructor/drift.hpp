#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "modules/reconstructor/ground_lean.hpp"

namespace limbcast::reconstructor {

struct DriftParams {
  /// Row difference that the matcher still bears [px]: the limit of limbcast-calibrate check, which
  /// a calibration that fits undercuts by far (0.08 px or less on all pairs of stereo_dev).
  double max_row_difference_px = 0.5;
  /// A pair with fewer corners says nothing.
  int min_corners = 30;
  /// Lean of the ground against gravity that is still believed [degrees]: three times what a told
  /// direction is off by (0.5), and more than all recordings with truth show (0.4).
  double max_lean_deg = 1.5;
  /// Measured at most so often [us]: a calibration drifts in hours.
  std::int64_t period_us = 1'000'000;
  /// The median of so many measurements counts, so that a few pairs whose images were not taken at
  /// the same time, or repeated patterns, raise no alarm; with fewer than the least nothing is
  /// said.
  std::size_t num_measurements = 9, min_measurements = 5;
};

/// Median of the last measurements of something.
class RecentMedian {
 public:
  explicit RecentMedian(const DriftParams& params) : params_(params) {}

  void add(double value);
  /// Nothing as long as there are too few.
  std::optional<double> value() const;

 private:
  DriftParams params_;
  std::deque<double> values_;
};

/// Tells from measurements of single pairs how far the calibration of a stereo camera is off.
class DriftMonitor {
 public:
  explicit DriftMonitor(const DriftParams& params = {});

  /// Whether a pair taken at `utime` should be measured.
  bool is_due(std::int64_t utime) const;
  /// What was measured on the pair of `utime` (row_differences_px, ground_lean).
  void add(std::int64_t utime, std::vector<double> row_differences_px,
           const std::optional<GroundLean>& ground = std::nullopt);

  /// Median row difference of the last measurements [px]; nothing as long as there are too few.
  std::optional<double> row_difference_px() const { return rows_px_.value(); }
  /// The same where it shows that the calibration has drifted.
  std::optional<double> drift_px() const;
  /// How the ground lies against told gravity where it shows that one of the two is off.
  std::optional<GroundLean> lean() const;

 private:
  DriftParams params_;
  std::optional<std::int64_t> last_utime_;
  RecentMedian rows_px_, offsets_px_, leans_deg_;
};

}  // namespace limbcast::reconstructor
