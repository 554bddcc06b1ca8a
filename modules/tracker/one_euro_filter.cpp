#include "modules/tracker/one_euro_filter.hpp"

#include <algorithm>
#include <cmath>

#include "common/units.hpp"

namespace limbcast::tracker {
namespace {

/// Weight of a new sample in an exponential filter of that cutoff.
float sample_weight(double cutoff_hz, double elapsed_s) {
  const double time_constant_s = 1.0 / (2.0 * kPi<double> * cutoff_hz);
  return static_cast<float>(elapsed_s / (elapsed_s + time_constant_s));
}

Eigen::Vector3f median(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                       const Eigen::Vector3f& c) {
  return a.cwiseMin(b).cwiseMax(a.cwiseMax(b).cwiseMin(c));
}

}  // namespace

void OneEuroFilter::restart(const Eigen::Vector3f& value) {
  started_ = true;
  value_ = last_measured_ = value;
  speed_.setZero();
  distance_.setZero();
  memory_ = 1.0;
}

void OneEuroFilter::update(const Eigen::Vector3f& value, double elapsed_s) {
  const bool may_be_wrong = rests() && !goes_on(value);
  const Eigen::Vector3f taken = may_be_wrong ? median(value, last_measured_, value_) : value;
  const Eigen::Vector3f measured_speed = (value - last_measured_) / static_cast<float>(elapsed_s);
  const float change = sample_weight(params_.speed_cutoff_hz, elapsed_s);
  speed_ += change * (measured_speed - speed_);
  distance_ += change * (taken - value_ - distance_);
  const double too_far = std::max(0.0, distance_.norm() - params_.rest_distance);
  const double motion = std::max(0.0, speed_.norm() - params_.rest_speed) +
                        2.0 * kPi<double> * params_.speed_cutoff_hz * too_far;
  const double cutoff_hz = params_.min_cutoff_hz + params_.speed_coefficient * motion;
  memory_ = std::min(memory_ + 1.0, 1.0 / sample_weight(cutoff_hz, elapsed_s));
  value_ += (taken - value_) / static_cast<float>(memory_);
  last_measured_ = value;
}

bool OneEuroFilter::goes_on(const Eigen::Vector3f& value) const {
  const Eigen::Vector3f before = last_measured_ - value_;
  return before.norm() > params_.rest_distance && before.dot(value - value_) > before.squaredNorm();
}

void OneEuroFilter::predict(double elapsed_s, double decay_s) {
  speed_ *= static_cast<float>(std::exp(-elapsed_s / decay_s));
  value_ += speed_ * static_cast<float>(elapsed_s);
}

}  // namespace limbcast::tracker
