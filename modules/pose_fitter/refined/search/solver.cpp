#include "modules/pose_fitter/refined/search/solver.hpp"

#include <algorithm>

#include "modules/pose_fitter/refined/search/linear_solver.hpp"

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
    : observation_(observation), params_(params), equations_(std::make_unique<NormalEquations>()) {}

CostTerms Solver::evaluate_at(const BodyState& body, const FitStage& stage,
                              NormalEquations& equations) {
  const CostTerms terms = evaluate(body, observation_, stage, params_, workspace_, equations);
  derive(body, observation_, stage, params_, workspace_, equations);
  return terms;
}

Real Solver::cost_at(const BodyState& body, const FitStage& stage) {
  evaluate(body, observation_, stage, params_, workspace_, *equations_);
  return equations_->cost;
}

Real Solver::minimize(BodyState& body, const FitStage& stage, int iterations, Real target) {
  const UnknownSet& unknowns = unknowns_of(stage.parts);
  Real cost = cost_at(body, stage), damping = kFirstDamping;
  bool derived = false;
  for (int i = 0; i < iterations; ++i) {
    if (!derived) derive(body, observation_, stage, params_, workspace_, *equations_);
    derived = true;
    const BodyState candidate = moved(body, limited(damped_step(*equations_, unknowns, damping)));
    const Real candidate_cost = cost_at(candidate, stage);
    if (!(candidate_cost < cost)) {
      damping *= kMoreDamping;
      if (damping > kMostDamping) break;
      continue;
    }
    const Real gain = cost - candidate_cost;
    body = candidate;
    cost = candidate_cost;
    derived = false;
    damping = std::max(kLeastDamping, kLessDamping * damping);
    if (gain < kLeastGain * cost) break;
    if (cost - gain * (iterations - i - 1) > target) break;
  }
  return cost;
}

}  // namespace limbcast::pose_fitter::refined
