#include "modules/pose_fitter/refined/cost.hpp"

#include "modules/pose_fitter/refined/image_term.hpp"

namespace limbcast::pose_fitter::refined {

CostTerms evaluate(const BodyState& body, const Observation& observation, const FitStage& stage,
                   const RefinedParams& params, bool derivatives, Workspace& workspace,
                   NormalEquations& equations) {
  equations.clear(derivatives);
  CostTerms terms;
  const Cones cones = make_cones_of(body);
  workspace.cones.clear();
  add_surface_term(cones, stage, params.robust_sigmas, workspace, equations);
  terms.surface = equations.cost;
  add_free_space_term(cones, observation, stage.parts, params.free_space_weight, workspace,
                      equations);
  add_skin_term(cones, observation, stage.parts, workspace, equations);
  terms.free_space = equations.cost - terms.surface;
  if (derivatives) workspace.cones.add_to(body, equations);
  add_prior_terms(body, cones, observation, stage.parts, params, equations);
  terms.priors = equations.cost - terms.surface - terms.free_space;
  add_image_term(body, observation, stage.parts, params, equations);
  terms.image = equations.cost - terms.surface - terms.free_space - terms.priors;
  return terms;
}

}  // namespace limbcast::pose_fitter::refined
