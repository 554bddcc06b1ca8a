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
  void add(int cone, float t, const Eigen::Vector3f& normal, float radius, float residual,
           float information);
  void add_to(const BodyState& body, NormalEquations& equations) const;

 private:
  /// Sums over residuals. Row of the Jacobian: ((1 - t) n, t n, -r, -r); so n n^T with three
  /// weights, r n and e n with two, and r^2, e r say all.
  struct Sums {
    std::array<float, 6> normals_from{}, normals_mixed{}, normals_to{};  ///< xx xy xz yy yz zz
    std::array<float, 3> radius_from{}, radius_to{}, residual_from{}, residual_to{};
    float radius2 = 0.0F, radius_residual = 0.0F;
    bool used = false;
  };
  std::array<Sums, kConeCount> sums_;
};

}  // namespace limbcast::pose_fitter::refined
