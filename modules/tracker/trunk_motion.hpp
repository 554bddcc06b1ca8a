#pragma once

#include <Eigen/Core>

namespace limbcast::tracker {

/// How a person walks, for the Kalman filter of the trunk.
struct TrunkMotionParams {
  /// Standard deviation of a measured trunk [m]: the mean error of the fitter's trunk joints.
  double measured_sigma_m = 0.05;
  /// Standard deviation of the acceleration [m/s^2]: people start and stop within about a second.
  double acceleration_sigma_m_s2 = 1.5;
  /// Standard deviation of the speed of somebody who was just seen first [m/s]: a walk.
  double first_speed_sigma_m_s = 1.0;
};

/// Kalman filter with constant velocity (Bar-Shalom, Li, Kirubarajan, Estimation with Applications
/// to Tracking and Navigation, 2001, chapter 6.2); the three axes share one covariance.
class TrunkMotion {
 public:
  TrunkMotion(const Eigen::Vector3f& position_m, const TrunkMotionParams& params);

  void predict(double elapsed_s);
  void update(const Eigen::Vector3f& position_m);

  const Eigen::Vector3f& position_m() const { return position_m_; }
  const Eigen::Vector3f& velocity_m_s() const { return velocity_m_s_; }
  /// Variance of the next measurement along each axis [m^2].
  double measurement_variance_m2() const;

 private:
  TrunkMotionParams params_;
  Eigen::Vector3f position_m_;
  Eigen::Vector3f velocity_m_s_ = Eigen::Vector3f::Zero();
  Eigen::Matrix2d covariance_;  ///< of position and velocity
};

}  // namespace limbcast::tracker
