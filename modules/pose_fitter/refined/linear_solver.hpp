#pragma once

#include <cstdint>
#include <vector>

#include "modules/pose_fitter/refined/normal_equations.hpp"

namespace limbcast::pose_fitter::refined {

/// Unknowns that a step may change, in the order of elimination.
struct UnknownSet {
  std::array<int, kUnknownCount> unknowns;
  int count = 0;
  /// Where the Hessian holds the lower triangle of these unknowns, column by column.
  std::vector<std::uint16_t> hessian_places;
};
/// The unknowns of those parts. A single arm is its points from the shoulder on; with the trunk
/// come size and rotation.
const UnknownSet& unknowns_of(unsigned parts);

/// Solves (H + damping * diag(H) + floor) * step = -gradient on the set; other unknowns stay.
/// Single precision: the damped system is well conditioned, and the descent checks each step by its
/// cost.
Eigen::Matrix<Real, kUnknownCount, 1> damped_step(const NormalEquations& equations,
                                                  const UnknownSet& set, Real damping);

}  // namespace limbcast::pose_fitter::refined
