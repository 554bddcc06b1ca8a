#pragma once

#include "modules/pose_fitter/refined/cost/normal_equations.hpp"

namespace limbcast::pose_fitter::refined {

/// Solves (H + damping * diag(H) + floor) * step = -gradient on the set; other unknowns stay.
/// Single precision: the damped system is well conditioned, and the descent checks each step by its
/// cost.
Eigen::Matrix<Real, kUnknownCount, 1> damped_step(const NormalEquations& equations,
                                                  const UnknownSet& set, Real damping);

}  // namespace limbcast::pose_fitter::refined
