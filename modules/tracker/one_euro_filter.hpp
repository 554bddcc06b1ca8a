#pragma once

#include <Eigen/Core>

namespace limbcast::tracker {

/// How a position is smoothed: G. Casiez, N. Roussel, D. Vogel, "1 Euro Filter", CHI 2012, with
/// three changes: a speed below which nothing counts as motion, because noise alone looks as fast
/// as that; a mean of all samples since the last motion until the cutoff allows no longer memory,
/// so that a value is steady soon after it came to rest; and at rest the median of the sample, the
/// one before and the smoothed value instead of the sample, so that one sample that is wrong does
/// not move it. Only the first sample of a motion out of rest is late for that: where the second
/// goes on from it, nothing is wrong.
struct OneEuroParams {
  /// Cutoff at rest [Hz]. Lower: less jitter. 0.05 Hz at 10 frames a second leaves 12 % of white
  /// noise.
  double min_cutoff_hz = 0.05;
  /// How much the cutoff rises with the speed beyond `rest_speed` [Hz per unit of the value / s].
  /// Higher: less lag. This one lets go at once of what moves.
  double speed_coefficient = 80.0;
  /// Speed that noise alone shows [unit of the value / s].
  double rest_speed = 0.25;
  /// Mean distance of the measured from the smoothed value that noise alone shows [unit]; more is a
  /// motion too slow for `rest_speed`.
  double rest_distance = 0.015;
  /// Cutoff of the speed and of that distance [Hz]; the paper has 1 Hz.
  double speed_cutoff_hz = 1.5;
  /// A value that is the mean of so many samples rests.
  int samples_to_rest = 3;
};

/// Low-pass filter of a point that is steady where it rests and quick where it moves.
class OneEuroFilter {
 public:
  explicit OneEuroFilter(const OneEuroParams& params) : params_(params) {}

  bool started() const { return started_; }
  /// Starts anew at `value`, at rest.
  void restart(const Eigen::Vector3f& value);
  /// Takes the value measured `elapsed_s` after the last measurement.
  void update(const Eigen::Vector3f& value, double elapsed_s);
  /// Goes on for `elapsed_s` without a measurement: the value moves at its speed, which dies away
  /// within `decay_s`.
  void predict(double elapsed_s, double decay_s);

  /// The smoothed value.
  const Eigen::Vector3f& value() const { return value_; }
  /// The last measured value.
  const Eigen::Vector3f& measured() const { return last_measured_; }
  /// Smoothed speed [unit of the value / s].
  const Eigen::Vector3f& speed() const { return speed_; }

 private:
  bool rests() const { return memory_ >= params_.samples_to_rest; }
  /// True where the last measurement was off by more than noise and `value` is farther that way.
  bool goes_on(const Eigen::Vector3f& value) const;

  OneEuroParams params_;
  bool started_ = false;
  Eigen::Vector3f value_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f last_measured_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f speed_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f distance_ = Eigen::Vector3f::Zero();  ///< of the measured value, smoothed
  double memory_ = 1.0;  ///< number of samples over which it averages
};

}  // namespace limbcast::tracker
