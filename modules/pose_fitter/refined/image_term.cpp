#include "modules/pose_fitter/refined/image_term.hpp"

#include <Eigen/Geometry>
#include <array>

namespace limbcast::pose_fitter::refined {
namespace {

/// What a joint belongs to; the shoulders go with the trunk, as in the search.
unsigned part_of(int joint) {
  if (joint < kElbow) return bit(Part::kTrunk);
  if (joint < kHip) return arm_bit((joint - kElbow) % 2);
  return joint < kKnee ? bit(Part::kTrunk) : bit(Part::kLegs);
}

/// The joint of the other side; a joint of the body's axis is its own.
int mirrored(int joint) {
  return joint < kShoulder ? joint : ((joint - kShoulder) ^ 1) + kShoulder;
}

/// Where the network marks a joint, against the joint's centre in the body's frame (of the left
/// side: outwards, up, to the front) [m]. Means of D1 to D3 and of simulated people, which agree to
/// 1 cm, as do D4 and D5.
const Vec3& mark_offset(int joint) {
  static const std::array<Vec3, 7> offsets = {Vec3(0.0, -0.033, 0.012),
                                              Vec3(-0.009, 0.020, 0.003),
                                              Vec3::Zero(),
                                              Vec3::Zero(),
                                              Vec3(-0.006, -0.023, 0.030),
                                              Vec3::Zero(),
                                              Vec3(-0.005, 0.022, 0.006)};
  return offsets[joint < kShoulder ? 0 : 1 + (joint - kShoulder) / 2];
}

/// 0 on the ray, 1 far off it.
Real share_of_limit(const SeenJoint& seen, const Vec3& point, const RefinedParams& params) {
  const Real limit_m = params.image_sigma_m * params.image_limit_sigmas;
  const Real ratio = point.cross(seen.ray).squaredNorm() / (limit_m * limit_m);
  return ratio / (1.0 + ratio);
}

/// What joints cost with the sides as the image tells them, and with left and right exchanged.
struct SideCosts {
  Real as_told = 0.0, exchanged = 0.0;
};

SideCosts side_costs(const BodyState& body, const Observation& observation, unsigned parts,
                     const RefinedParams& params) {
  SideCosts costs;
  for (int joint = 0; joint < kJointCount; ++joint) {
    if ((parts & part_of(joint)) == 0) continue;
    const Vec3 place = marked_place(body, joint);
    costs.as_told += image_cost(observation.seen_joints[joint], place, params);
    costs.exchanged += image_cost(observation.seen_joints[mirrored(joint)], place, params);
  }
  costs.exchanged += params.image_swap_cost;
  return costs;
}

}  // namespace

Vec3 marked_place(const BodyState& body, int joint) {
  Vec3 offset = mark_offset(joint);
  if (joint >= kShoulder) offset.x() *= side_sign((joint - kShoulder) % 2);
  return body.points[joint] + body.rotation * offset;
}

Real image_cost(const SeenJoint& seen, const Vec3& point, const RefinedParams& params) {
  if (seen.visibility <= 0.0) return 0.0;
  const Real limit2 = params.image_limit_sigmas * params.image_limit_sigmas;
  return 0.5 * params.image_weight * seen.visibility * limit2 * share_of_limit(seen, point, params);
}

ImageEvidence image_evidence(const BodyState& body, const Observation& observation,
                             const RefinedParams& params) {
  ImageEvidence evidence;
  evidence.told = observation.has_image_pose;
  if (!evidence.told) return evidence;
  evidence.person_score = observation.image_person_score;
  evidence.sides_swapped = image_takes_sides_otherwise(body, observation, kAllParts, params);
  for (int joint = 0; joint < kJointCount; ++joint) {
    const SeenJoint& seen =
        observation.seen_joints[evidence.sides_swapped ? mirrored(joint) : joint];
    evidence.visibility[joint] = seen.visibility;
    evidence.disagreement[joint] = share_of_limit(seen, marked_place(body, joint), params);
  }
  return evidence;
}

bool image_takes_sides_otherwise(const BodyState& body, const Observation& observation,
                                 unsigned parts, const RefinedParams& params) {
  const SideCosts costs = side_costs(body, observation, parts | bit(Part::kTrunk), params);
  return costs.exchanged < costs.as_told;
}

void add_image_term(const BodyState& body, const Observation& observation, unsigned parts,
                    const RefinedParams& params, NormalEquations& equations) {
  if (!observation.has_image_pose) return;
  const unsigned parts_and_trunk = parts | bit(Part::kTrunk);
  const SideCosts with_trunk = side_costs(body, observation, parts_and_trunk, params);
  const bool swapped = with_trunk.exchanged < with_trunk.as_told;
  const SideCosts costs =
      parts == parts_and_trunk ? with_trunk : side_costs(body, observation, parts, params);
  equations.cost += swapped ? costs.exchanged : costs.as_told;
  if (!equations.derivatives()) return;
  const Real sigma2 = params.image_sigma_m * params.image_sigma_m;
  const Real limit2 = params.image_limit_sigmas * params.image_limit_sigmas;
  for (int joint = 0; joint < kJointCount; ++joint) {
    const SeenJoint& seen = observation.seen_joints[swapped ? mirrored(joint) : joint];
    if (seen.visibility <= 0.0 || (parts & part_of(joint)) == 0) continue;
    const Vec3 point = marked_place(body, joint);
    const Real shrink = 1.0 / (1.0 + point.cross(seen.ray).squaredNorm() / (sigma2 * limit2));
    const Real information = params.image_weight * seen.visibility * shrink * shrink / sigma2;
    // Two directions across the ray; along it the image tells nothing.
    const Vec3 first = seen.ray.unitOrthogonal();
    for (const Vec3& direction : {first, Vec3(seen.ray.cross(first))}) {
      equations.start_row();
      equations.derivative_of_point(joint, direction);
      equations.add_row(direction.dot(point), information);
    }
  }
}

}  // namespace limbcast::pose_fitter::refined
