#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace limbcast::reconstructor {

struct DriftParams {
  /// Row difference that the matcher still bears [px]: the limit of limbcast-calibrate check, which
  /// a calibration that fits undercuts by far (0.08 px or less on all pairs of stereo_dev).
  double max_row_difference_px = 0.5;
  /// A pair with fewer corners says nothing.
  int min_corners = 30;
  /// Measured at most so often [us]: a calibration drifts in hours.
  std::int64_t period_us = 1'000'000;
  /// The median of so many measurements counts, so that a few pairs whose images were not taken at
  /// the same time, or repeated patterns, raise no alarm; with fewer than the least nothing is
  /// said.
  std::size_t num_measurements = 9, min_measurements = 5;
};

/// Tells from measurements of single pairs how far the calibration of a stereo camera is off.
class DriftMonitor {
 public:
  explicit DriftMonitor(const DriftParams& params = {}) : params_(params) {}

  /// Whether a pair taken at `utime` should be measured.
  bool is_due(std::int64_t utime) const;
  /// What was measured on the pair of `utime` (row_differences_px).
  void add(std::int64_t utime, std::vector<double> row_differences_px);

  /// Median row difference of the last measurements [px]; nothing as long as there are too few.
  std::optional<double> row_difference_px() const;
  /// The same where it shows that the calibration has drifted.
  std::optional<double> drift_px() const;

 private:
  DriftParams params_;
  std::optional<std::int64_t> last_utime_;
  std::deque<double> measurements_px_;
};

}  // namespace limbcast::reconstructor
