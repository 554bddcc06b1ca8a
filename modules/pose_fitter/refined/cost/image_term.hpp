#pragma once

#include <optional>

#include "modules/pose_fitter/refined/body_state.hpp"
#include "modules/pose_fitter/refined/cost/normal_equations.hpp"
#include "modules/pose_fitter/refined/observation.hpp"

namespace limbcast::pose_fitter::refined {

/// The place that a network marks for a joint: hips are marked more to the front than their
/// centres, shoulders higher.
Vec3 marked_place(const BodyState& body, int joint, ImageNetwork network);

/// How a body agrees with what a network sees; nothing is told where it did not look.
struct ImageEvidence {
  bool told = false;
  Real person_score = 0.0;     ///< 0 to 1
  bool sides_swapped = false;  ///< it fits better where the image takes left for right
  /// How much better it fits with left and right as the network tells them than exchanged, -1 to 1.
  Real sides_agreement = 0.0;
  /// Of each joint how sure the network is that it is in sight, and how far off it stands: 0 on the
  /// ray, 1 far off it.
  std::array<Real, kJointCount> visibility{}, disagreement{};
};
std::array<ImageEvidence, kImageNetworkCount> image_evidence(const BodyState& body,
                                                             const Observation& observation,
                                                             const RefinedParams& params);

/// How far away the middle of the hips is along the optical axis [m].
Real hips_depth_m(const BodyState& body);

/// What a joint at `point` costs, as far as it stands off the ray on which a network sees
/// `seen_joint`, and off the depth that it tells, of a body whose hips are `hips_m` away.
Real image_cost(const ImageLook& look, int seen_joint, const Vec3& point, Real hips_m,
                const RefinedParams& params);

/// Whether the joints of `parts` and of the trunk fit what a network sees better where it takes
/// left for right.
bool takes_sides_otherwise(const BodyState& body, const ImageLook& look, unsigned parts,
                           const RefinedParams& params);

/// Where an arm points, from the shoulder to the wrist, by the network that tells depths, of a body
/// that agrees with the networks as `evidence` tells; nothing where none looked.
std::optional<Vec3> seen_arm_axis(const BodyState& body, const Observation& observation, int side,
                                  const std::array<ImageEvidence, kImageNetworkCount>& evidence);

/// Joints stand on the rays on which the networks see them, as far away as those tell whose
/// depths have a weight.
void add_image_term(const BodyState& body, const Observation& observation, unsigned parts,
                    const RefinedParams& params, NormalEquations& equations);

}  // namespace limbcast::pose_fitter::refined
