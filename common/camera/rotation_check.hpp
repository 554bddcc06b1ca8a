#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <limits>

namespace limbcast {

/// Rounding to 4 digits, as some tools write, keeps a rotation within this of orthonormal.
inline constexpr double kRotationTolerance = 1e-3;

/// How far a matrix is from a rotation: largest coefficient of R R^T - 1; infinite for a mirror.
inline double deviation_from_rotation(const Eigen::Matrix3d& R) {
  if (R.determinant() < 0.0) return std::numeric_limits<double>::infinity();
  return (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

}  // namespace limbcast
