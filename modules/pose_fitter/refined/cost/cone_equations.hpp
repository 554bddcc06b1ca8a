#pragma once

#include <cstdint>
#include <vector>

#include "modules/pose_fitter/refined/body_state.hpp"
#include "modules/pose_fitter/refined/cost/normal_equations.hpp"

namespace limbcast::pose_fitter::refined {

/// Residuals that depend on one cone only, and their normal equations in the cone's own eight
/// variables: its two ends, logarithm of stature and of girth (through the radius). Hundreds of
/// residuals are summed here and handed to the body's unknowns once, where a step is taken from
/// them.
class ConeEquations {
 public:
  /// Residuals of which there are many, in columns; cone: -1 of those that do not count.
  struct Columns {
    std::vector<std::int32_t> cone;
    std::vector<float> t, x, y, z, radius, residual, information;
    void resize(std::size_t size);
  };

  void clear() {
    many_.resize(0);
    rows_.clear();
  }
  /// Are summed before what is added one by one.
  Columns& many() { return many_; }
  /// A residual that changes by `normal` per metre of the axis point at `t` and by -`radius` per
  /// unit of the logarithm of the size.
  void add(int cone, float t, const Eigen::Vector3f& normal, float radius, float residual,
           float information) {
    rows_.push_back({cone, t, normal, radius, residual, information});
  }
  void add_to(const BodyState& body, NormalEquations& equations) const;

 private:
  struct Row {
    int cone;
    float t;
    Eigen::Vector3f normal;
    float radius, residual, information;
  };
  Columns many_;
  std::vector<Row> rows_;
};

}  // namespace limbcast::pose_fitter::refined
