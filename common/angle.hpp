#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "common/units.hpp"

namespace limbcast {

/// Angle between two vectors of space, of any length, 0 to pi; exact for small angles too.
template <class A, class B>
double angle_rad(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  const Eigen::Matrix<typename A::Scalar, 3, 1> first = a, second = b;
  return std::atan2(first.cross(second).norm(), first.dot(second));
}

template <class A, class B>
double angle_deg(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return angle_rad(a, b) * kDegreesPerRadian<double>;
}

}  // namespace limbcast
