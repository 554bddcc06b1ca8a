#include "modules/pose_fitter/refined/cost/cost.hpp"

#include "modules/pose_fitter/refined/cost/image_term.hpp"

namespace limbcast::pose_fitter::refined {

CostTerms evaluate(const BodyState& body, const Observation& observation, const FitStage& stage,
                   const RefinedParams& params, Workspace& workspace, NormalEquations& equations) {
  equations.clear(false);
  CostTerms terms;
  const Cones& cones = workspace.body_cones = make_cones_of(body);
  workspace.cones.clear();
  add_surface_term(cones, stage, params.robust_sigmas, workspace, equations);
  terms.surface = equations.cost;
  add_free_space_term(cones, observation, stage.parts, params.silhouette_weight, workspace,
                      equations);
  add_skin_term(cones, observation, stage.parts, workspace, equations);
  terms.free_space = equations.cost - terms.surface;
  add_prior_terms(body, cones, observation, stage.parts, params, equations);
  terms.priors = equations.cost - terms.surface - terms.free_space;
  add_image_term(body, observation, stage.parts, params, equations);
  terms.image = equations.cost - terms.surface - terms.free_space - terms.priors;
  return terms;
}

void derive(const BodyState& body, const Observation& observation, const FitStage& stage,
            const RefinedParams& params, const Workspace& workspace, NormalEquations& equations) {
  const Real cost = equations.cost;
  equations.clear(unknowns_of(stage.parts));
  workspace.cones.add_to(body, equations);
  add_prior_terms(body, workspace.body_cones, observation, stage.parts, params, equations);
  add_image_term(body, observation, stage.parts, params, equations);
  equations.cost = cost;
}

}  // namespace limbcast::pose_fitter::refined
