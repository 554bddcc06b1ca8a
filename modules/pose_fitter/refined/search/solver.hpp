#pragma once

#include <limits>
#include <memory>

#include "modules/pose_fitter/refined/cost/cost.hpp"

namespace limbcast::pose_fitter::refined {

/// Levenberg-Marquardt on the cost. Holds buffers: one for each thread.
class Solver {
 public:
  Solver(const Observation& observation, const RefinedParams& params);

  /// Lowers the cost from `body` on, in at most `iterations` steps; returns the cost. Ends early
  /// where even as much gain in each step left would not bring the cost below `target`.
  Real minimize(BodyState& body, const FitStage& stage, int iterations,
                Real target = std::numeric_limits<Real>::infinity());
  /// Cost and normal equations at `body`.
  CostTerms evaluate_at(const BodyState& body, const FitStage& stage, NormalEquations& equations);

  const Observation& observation() const { return observation_; }
  const RefinedParams& params() const { return params_; }

 private:
  Real cost_at(const BodyState& body, const FitStage& stage);

  const Observation& observation_;
  const RefinedParams& params_;
  Workspace workspace_;
  std::unique_ptr<NormalEquations> equations_;
};

}  // namespace limbcast::pose_fitter::refined
