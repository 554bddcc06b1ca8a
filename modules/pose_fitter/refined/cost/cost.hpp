#pragma once

#include <cstdint>
#include <vector>

#include "modules/pose_fitter/refined/body_state.hpp"
#include "modules/pose_fitter/refined/cost/cone_equations.hpp"
#include "modules/pose_fitter/refined/cost/normal_equations.hpp"
#include "modules/pose_fitter/refined/observation.hpp"

namespace limbcast::pose_fitter::refined {

/// What lies nearer to the sensor is in no image [m].
inline constexpr Real kNearestM = 0.3;

/// Nearest cone of each point: signed distance to its surface [m], place on its axis (0 to 1), its
/// index. Columns are padded as those of the points are.
struct NearestCones {
  std::vector<float> distance, place;
  std::vector<std::int32_t> cone;
};

/// Which parts of the body are fitted to which points, how closely.
struct FitStage {
  const PointColumns* points;
  unsigned parts;
  Real surface_sigma_m;
  /// The other parts, which stay where they are; null: there are none.
  const NearestCones* fixed = nullptr;
};

/// What the terms of the cost add up to, for looking at.
struct CostTerms {
  Real surface = 0.0, free_space = 0.0, priors = 0.0, image = 0.0;
};

/// What one look at the cost leaves for its derivatives.
struct Workspace {
  Cones body_cones;
  NearestCones nearest;
  std::vector<float> costs;  ///< of the points
  ConeEquations cones;
};

/// Points lie on the surface of the nearest cone.
void add_surface_term(const Cones& cones, const FitStage& stage, Real robust_sigmas,
                      Workspace& workspace, NormalEquations& equations);

/// No part stands where the sensor saw through or before the surface it saw.
void add_free_space_term(const Cones& cones, const Observation& observation, unsigned parts,
                         Real silhouette_weight, Workspace& workspace, NormalEquations& equations);

/// Hands are skin-coloured, most often: they stand where such pixels are.
void add_skin_term(const Cones& cones, const Observation& observation, unsigned parts,
                   Workspace& workspace, NormalEquations& equations);

/// What is known of bodies without looking: proportions, joint limits, parts not in one another,
/// the ground.
void add_prior_terms(const BodyState& body, const Cones& cones, const Observation& observation,
                     unsigned parts, const RefinedParams& params, NormalEquations& equations);

/// A trunk turned against what the face and the depths that the image's network tells say of its
/// front; no part of `evaluate`, as it chooses between bodies and turns none.
Real front_cost(const BodyState& body, const Observation& observation, const RefinedParams& params);

/// Log odds by which a face that was seen speaks for a trunk's front, or against it; 0 of none.
Real face_agreement(const Vec3& front, const Observation& observation);

/// How far a front points across the line of sight, 0 to 1: 1 of somebody seen from the side.
Real sideways(const Vec3& front, const Observation& observation);

/// Looks for the nearest among the cones of `parts` and what `fixed` holds (may be null).
void nearest_cones(const PointColumns& points, const Cones& cones, unsigned parts,
                   const NearestCones* fixed, NearestCones& nearest);

/// The whole cost, without derivatives.
CostTerms evaluate(const BodyState& body, const Observation& observation, const FitStage& stage,
                   const RefinedParams& params, Workspace& workspace, NormalEquations& equations);

/// The normal equations of the stage's unknowns at the body that was evaluated last; apart, as no
/// step is taken from most bodies that are looked at.
void derive(const BodyState& body, const Observation& observation, const FitStage& stage,
            const RefinedParams& params, const Workspace& workspace, NormalEquations& equations);

}  // namespace limbcast::pose_fitter::refined
