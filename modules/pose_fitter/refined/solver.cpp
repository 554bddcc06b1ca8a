#include "modules/pose_fitter/refined/solver.hpp"

#include <algorithm>
#include <utility>

#include "modules/pose_fitter/refined/linear_solver.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

constexpr Real kFirstDamping = 1e-2, kLeastDamping = 1e-6, kMostDamping = 1e4;
constexpr Real kLessDamping = 0.3, kMoreDamping = 6.0;
/// No point moves farther in one step [m]: the nearest cones change on the way.
constexpr Real kLongestStepM = 0.25;
/// Steps that win less than this share of the cost end the descent.
constexpr Real kLeastGain = 5e-4;

Step limited(Step step) {
  const Real longest = step.head<3 * kPointCount>().cwiseAbs().maxCoeff();
  if (longest > kLongestStepM) step *= kLongestStepM / longest;
  return step;
}

}  // namespace

Solver::Solver(const Observation& observation, const RefinedParams& params)
    : observation_(observation),
      params_(params),
      current_(std::make_unique<NormalEquations>()),
      trial_(std::make_unique<NormalEquations>()) {}

CostTerms Solver::evaluate_at(const BodyState& body, const FitStage& stage,
                              NormalEquations& equations) {
  ++evaluations_;
  return evaluate(body, observation_, stage, params_, true, workspace_, equations);
}

Real Solver::minimize(BodyState& body, const FitStage& stage, int iterations, Real target) {
  evaluate_at(body, stage, *current_);
  const UnknownSet& unknowns = unknowns_of(stage.parts);
  Real damping = kFirstDamping;
  for (int i = 0; i < iterations; ++i) {
    const BodyState candidate = moved(body, limited(damped_step(*current_, unknowns, damping)));
    evaluate_at(candidate, stage, *trial_);
    if (!(trial_->cost < current_->cost)) {
      damping *= kMoreDamping;
      if (damping > kMostDamping) break;
      continue;
    }
    const Real gain = current_->cost - trial_->cost;
    body = candidate;
    std::swap(current_, trial_);
    damping = std::max(kLeastDamping, kLessDamping * damping);
    if (gain < kLeastGain * current_->cost) break;
    if (current_->cost - gain * (iterations - i - 1) > target) break;
  }
  return current_->cost;
}

}  // namespace limbcast::pose_fitter::refined
