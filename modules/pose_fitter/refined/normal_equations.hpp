#pragma once

#include "modules/pose_fitter/refined/unknown_set.hpp"

namespace limbcast::pose_fitter::refined {

/// Sum of squared residuals with its Gauss-Newton normal equations; only the lower triangle is
/// kept.
class NormalEquations {
 public:
  Eigen::Matrix<Real, kUnknownCount, kUnknownCount> hessian = decltype(hessian)::Zero();
  Eigen::Matrix<Real, kUnknownCount, 1> gradient = decltype(gradient)::Zero();
  Real cost = 0.0;

  /// With the derivatives by all unknowns or, where none are wanted, by none: then the ones from
  /// before stay.
  void clear(bool derivatives) {
    if (derivatives) return clear(unknowns_of(kAllParts));
    cost = 0.0;
    derivatives_ = false;
    wanted_.fill(false);
  }
  /// With the derivatives by these unknowns alone.
  void clear(const UnknownSet& unknowns) {
    cost = 0.0;
    derivatives_ = true;
    wanted_ = unknowns.contains;
    for (const std::uint16_t place : unknowns.hessian_places) hessian.data()[place] = 0.0;
    gradient.setZero();
  }
  bool derivatives() const { return derivatives_; }
  bool wants(int unknown) const { return wanted_[unknown]; }
  bool wants_point(int point) const { return wanted_[3 * point]; }

  /// A row of the Jacobian is put together between start_row and add_residual.
  void start_row() { count_ = 0; }
  void derivative(int unknown, Real value) {
    unknowns_[count_] = unknown;
    values_[count_] = value;
    if (wanted_[unknown]) ++count_;
  }
  void derivative_of_point(int point, const Vec3& value) {
    if (!wants_point(point)) return;
    for (int axis = 0; axis < 3; ++axis) derivative(3 * point + axis, value[axis]);
  }
  /// 0.5 * (residual / sigma)^2.
  void add_residual(Real residual, Real sigma) {
    const Real information = 1.0 / (sigma * sigma);
    cost += 0.5 * information * residual * residual;
    if (derivatives_) add_row(residual, information);
  }
  /// The same with a Geman-McClure loss that saturates at 0.5 * limit^2 (limit in sigmas).
  void add_robust_residual(Real residual, Real sigma, Real limit) {
    const Real information = 1.0 / (sigma * sigma);
    const Real ratio = information * residual * residual / (limit * limit),
               shrink = 1.0 / (1.0 + ratio);
    cost += 0.5 * limit * limit * ratio * shrink;
    if (derivatives_) add_row(residual, information * shrink * shrink);
  }

  /// The row alone, without what the residual costs.
  void add_row(Real residual, Real information) {
    for (int a = 0; a < count_; ++a) {
      const Real weighted = values_[a] * information;
      gradient[unknowns_[a]] += weighted * residual;
      for (int b = 0; b < count_; ++b) {
        // An unknown may stand in a row twice; each ordered pair adds to the lower triangle once.
        if (unknowns_[b] <= unknowns_[a])
          hessian(unknowns_[a], unknowns_[b]) += weighted * values_[b];
      }
    }
  }

 private:
  bool derivatives_ = false;
  std::array<bool, kUnknownCount> wanted_{};
  int count_ = 0;
  std::array<int, 48> unknowns_;
  std::array<Real, 48> values_;
};

}  // namespace limbcast::pose_fitter::refined
