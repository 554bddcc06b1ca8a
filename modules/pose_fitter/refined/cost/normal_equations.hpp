#pragma once

#include "modules/pose_fitter/refined/cost/unknown_set.hpp"

namespace limbcast::pose_fitter::refined {

/// Sum of squared residuals with its Gauss-Newton normal equations; of the Hessian the lower
/// triangle counts.
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
    std::array<Real, kMostInRow> weighted;
    for (int a = 0; a < count_; ++a) {
      weighted[a] = values_[a] * information;
      gradient[unknowns_[a]] += weighted[a] * residual;
    }
    // An unknown may stand in a row twice: each ordered pair adds once. Adding to the upper
    // triangle too is faster than asking.
    for (int b = 0; b < count_; ++b) {
      Real* const column = &hessian(0, unknowns_[b]);
      for (int a = 0; a < count_; ++a) column[unknowns_[a]] += weighted[a] * values_[b];
    }
  }

 private:
  static constexpr int kMostInRow = 48;

  bool derivatives_ = false;
  std::array<bool, kUnknownCount> wanted_{};
  int count_ = 0;
  std::array<int, kMostInRow> unknowns_;
  std::array<Real, kMostInRow> values_;
};

}  // namespace limbcast::pose_fitter::refined
