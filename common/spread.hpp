#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace limbcast {

/// Mean and covariance of weighted points.
class Spread {
 public:
  void add(const Eigen::Vector3d& point, double weight = 1.0) {
    weight_ += weight;
    sum_ += weight * point;
    squares_ += weight * point * point.transpose();
  }

  double weight() const { return weight_; }
  Eigen::Vector3d mean() const { return sum_ / weight_; }

  /// Of the covariance, smallest first: variances along the principal axes.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal_axes() const {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(squares_ / weight_ -
                                                          mean() * mean().transpose());
  }

  /// Standard deviations along the principal axes, smallest first; none of no points.
  Eigen::Vector3d extent() const {
    if (weight_ <= 0.0) return Eigen::Vector3d::Zero();
    return principal_axes().eigenvalues().cwiseMax(0.0).cwiseSqrt();
  }

 private:
  double weight_ = 0.0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
};

}  // namespace limbcast
