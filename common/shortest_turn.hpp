#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace limbcast {

/// The shortest rotation that takes the direction of `from` to that of `to` (any lengths but 0),
/// about any axis across them where they are opposite. As Eigen's FromTwoVectors, which for that
/// one case brings in a singular value decomposition: ten seconds more to compile each file that
/// uses it.
template <class Scalar>
Eigen::Quaternion<Scalar> shortest_turn(const Eigen::Matrix<Scalar, 3, 1>& from,
                                        const Eigen::Matrix<Scalar, 3, 1>& to) {
  const Eigen::Matrix<Scalar, 3, 1> a = from.normalized(), b = to.normalized();
  const Scalar cosine = b.dot(a);
  Eigen::Quaternion<Scalar> turn;
  if (cosine < Eigen::NumTraits<Scalar>::dummy_precision() - Scalar(1)) {
    turn.w() = Scalar(0);
    turn.vec() = a.unitOrthogonal();
    return turn;
  }
  const Scalar twice_w = std::sqrt((Scalar(1) + cosine) * Scalar(2));
  turn.vec() = a.cross(b) * (Scalar(1) / twice_w);
  turn.w() = twice_w * Scalar(0.5);
  return turn;
}

}  // namespace limbcast
