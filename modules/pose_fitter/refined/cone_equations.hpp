#pragma once

#include "modules/pose_fitter/refined/body_state.hpp"
#include "modules/pose_fitter/refined/normal_equations.hpp"

namespace limbcast::pose_fitter::refined {

/// Normal equations of residuals that depend on one cone only, in the cone's own eight variables:
/// its two ends, logarithm of stature and of girth (through the radius). Hundreds of residuals are
/// summed here and handed to the body's unknowns once.
class ConeEquations {
 public:
  void clear();
  /// A residual that changes by `normal` per metre of the axis point at `t` and by -`radius` per
  /// unit of the logarithm of the size.
  void add(int cone, Real t, const Vec3& normal, Real radius, Real residual, Real information);
  void add_to(const BodyState& body, NormalEquations& equations) const;

 private:
  static constexpr int kVariables = 8;
  struct Block {
    Eigen::Matrix<Real, kVariables, kVariables> hessian;
    Eigen::Matrix<Real, kVariables, 1> gradient;
    bool used = false;
  };
  std::array<Block, kConeCount> blocks_;
};

}  // namespace limbcast::pose_fitter::refined
