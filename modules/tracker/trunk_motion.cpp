#include "modules/tracker/trunk_motion.hpp"

namespace limbcast::tracker {
namespace {

double squared(double x) { return x * x; }

}  // namespace

TrunkMotion::TrunkMotion(const Eigen::Vector3f& position_m, const TrunkMotionParams& params)
    : params_(params), position_m_(position_m) {
  covariance_ << squared(params.measured_sigma_m), 0.0, 0.0, squared(params.first_speed_sigma_m_s);
}

void TrunkMotion::predict(double elapsed_s) {
  position_m_ += velocity_m_s_ * static_cast<float>(elapsed_s);
  Eigen::Matrix2d transition;
  transition << 1.0, elapsed_s, 0.0, 1.0;
  const Eigen::Vector2d by_acceleration(0.5 * elapsed_s * elapsed_s, elapsed_s);
  covariance_ =
      transition * covariance_ * transition.transpose() +
      squared(params_.acceleration_sigma_m_s2) * by_acceleration * by_acceleration.transpose();
}

double TrunkMotion::measurement_variance_m2() const {
  return covariance_(0, 0) + squared(params_.measured_sigma_m);
}

void TrunkMotion::update(const Eigen::Vector3f& position_m) {
  const Eigen::Vector2d gain = covariance_.col(0) / measurement_variance_m2();
  const Eigen::Vector3f innovation = position_m - position_m_;
  position_m_ += static_cast<float>(gain[0]) * innovation;
  velocity_m_s_ += static_cast<float>(gain[1]) * innovation;
  covariance_ -= gain * covariance_.row(0).eval();
}

}  // namespace limbcast::tracker
