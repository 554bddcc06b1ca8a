#pragma once

#include "modules/pose_fitter/refined/body_state.hpp"
#include "modules/pose_fitter/refined/normal_equations.hpp"
#include "modules/pose_fitter/refined/observation.hpp"

namespace limbcast::pose_fitter::refined {

/// The place that the image's network marks for a joint: hips are marked more to the front than
/// their centres, shoulders higher.
Vec3 marked_place(const BodyState& body, int joint);

/// How a body agrees with what the image shows; nothing is told where there is no image.
struct ImageEvidence {
  bool told = false;
  Real person_score = 0.0;     ///< of the image's network, 0 to 1
  bool sides_swapped = false;  ///< it fits better where the image takes left for right
  /// Of each joint how sure the network is that it is in sight, and how far off it stands: 0 on the
  /// ray, 1 far off it.
  std::array<Real, kJointCount> visibility{}, disagreement{};
};
ImageEvidence image_evidence(const BodyState& body, const Observation& observation,
                             const RefinedParams& params);

/// What a joint at `point` costs, as far as it stands off the ray on which the image shows it.
Real image_cost(const SeenJoint& seen, const Vec3& point, const RefinedParams& params);

/// Whether the joints of `parts` and of the trunk fit the image better where it takes left for
/// right.
bool image_takes_sides_otherwise(const BodyState& body, const Observation& observation,
                                 unsigned parts, const RefinedParams& params);

/// Joints stand on the rays on which the image shows them.
void add_image_term(const BodyState& body, const Observation& observation, unsigned parts,
                    const RefinedParams& params, NormalEquations& equations);

}  // namespace limbcast::pose_fitter::refined
