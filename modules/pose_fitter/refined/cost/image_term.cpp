#include "modules/pose_fitter/refined/cost/image_term.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace limbcast::pose_fitter::refined {
namespace {

Real square(Real value) { return value * value; }

/// What a joint belongs to; the shoulders go with the trunk, as in the search.
unsigned part_of(int joint) {
  if (joint < kElbow) return bit(Part::kTrunk);
  if (joint < kHip) return arm_bit((joint - kElbow) % 2);
  return joint < kKnee ? bit(Part::kTrunk) : bit(Part::kLegs);
}

/// Where a network marks joints, against their centres.
struct Marks {
  /// In the body's frame (of the left side: outwards, up, to the front) [m]: head, shoulders of
  /// arms held out, elbows, wrists, hips, knees, ankles.
  std::array<Vec3, 7> offsets;
  /// How much higher the shoulder of a hanging arm is marked, and lower that of one that points up
  /// [m].
  Real shoulder_drop_m;
};

/// Medians of D1 to D3 and of simulated people, which agree to 1 cm, as do D4 and D5; heights of
/// shoulders and wrists by what directions of D1 to D3 leave across the image.
const Marks& marks_of(ImageNetwork network) {
  static const Marks blaze_pose = {
      {Vec3(0.0, -0.033, 0.012), Vec3(-0.009, 0.004, 0.003), Vec3::Zero(), Vec3(0.0, 0.004, 0.0),
       Vec3(-0.006, -0.023, 0.030), Vec3::Zero(), Vec3(-0.005, 0.022, 0.006)},
      0.011};
  static const Marks move_net = {
      {Vec3(0.0, -0.033, 0.012), Vec3(-0.005, 0.011, 0.003), Vec3::Zero(), Vec3(0.0, 0.004, 0.0),
       Vec3(-0.002, 0.010, 0.028), Vec3(0.0, -0.010, 0.004), Vec3(0.0, 0.010, 0.005)},
      0.021};
  // It was trained on the joints' centres.
  static const Marks depth_pose = {{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(),
                                    Vec3::Zero(), Vec3::Zero(), Vec3::Zero()},
                                   0.0};
  switch (network) {
    case ImageNetwork::kBlazePose:
      return blaze_pose;
    case ImageNetwork::kMoveNet:
      return move_net;
    case ImageNetwork::kDepthPose:
      break;
  }
  return depth_pose;
}

Real limit_of(ImageNetwork network, const RefinedParams& params) {
  return params.image_sigma_m[static_cast<std::size_t>(network)] * params.image_limit_sigmas;
}

/// 0 where there is no error, 1 far beyond the limit (Geman-McClure).
Real saturated(Real square_error, Real limit) {
  const Real ratio = square_error / square(limit);
  return ratio / (1.0 + ratio);
}

/// 0 on the ray, 1 far off it.
Real share_of_limit(const SeenJoint& seen, const Vec3& point, Real limit_m) {
  return saturated(point.cross(seen.ray).squaredNorm(), limit_m * seen.spread);
}

/// How much farther away than the network tells.
Real depth_error_m(const SeenJoint& seen, const Vec3& point, Real hips_m) {
  return point.z() - hips_m - seen.behind_hips_m;
}

Real depth_sigma_m(const SeenJoint& seen, const RefinedParams& params) {
  return params.image_depth_sigma_m * seen.spread;
}

/// 0 as far away as the network tells, 1 far off.
Real share_of_depth_limit(const SeenJoint& seen, Real error_m, const RefinedParams& params) {
  return saturated(square(error_m), depth_sigma_m(seen, params) * params.image_limit_sigmas);
}

/// A joint is as far behind the hips as the network tells.
void add_depth_row(const ImageLook& look, const SeenJoint& seen, int joint, Real error_m,
                   const RefinedParams& params, NormalEquations& equations) {
  const Real shrink = 1.0 - share_of_depth_limit(seen, error_m, params);
  equations.start_row();
  equations.derivative_of_point(joint, Vec3::UnitZ());
  for (int side = 0; side < 2; ++side)
    equations.derivative_of_point(kHip + side, -0.5 * Vec3::UnitZ());
  equations.add_row(
      error_m, look.depth_weight * seen.visibility * square(shrink / depth_sigma_m(seen, params)));
}

/// Beyond this difference of cost the sides are as clear as they get: two joints far off their
/// rays.
constexpr Real kClearSidesGap = 9.0;

/// What joints cost with the sides as the image tells them, and with left and right exchanged.
struct SideCosts {
  Real as_told = 0.0, exchanged = 0.0;
};

SideCosts side_costs(const BodyState& body, const ImageLook& look, unsigned parts,
                     const RefinedParams& params) {
  SideCosts costs;
  const Real hips_m = hips_depth_m(body);
  for (int joint = 0; joint < kJointCount; ++joint) {
    if ((parts & part_of(joint)) == 0) continue;
    const Vec3 place = marked_place(body, joint, look.network);
    costs.as_told += image_cost(look, joint, place, hips_m, params);
    costs.exchanged += image_cost(look, mirrored(joint), place, hips_m, params);
  }
  costs.exchanged += params.image_swap_cost;
  return costs;
}

ImageEvidence evidence_of(const BodyState& body, const ImageLook& look,
                          const RefinedParams& params) {
  ImageEvidence evidence;
  evidence.told = true;
  evidence.person_score = look.person_score;
  const SideCosts costs = side_costs(body, look, kAllParts, params);
  evidence.sides_swapped = costs.exchanged < costs.as_told;
  const Real gap = (costs.exchanged - params.image_swap_cost - costs.as_told) / look.weight;
  evidence.sides_agreement = std::clamp(gap / kClearSidesGap, -1.0, 1.0);
  for (int joint = 0; joint < kJointCount; ++joint) {
    const SeenJoint& seen = look.joints[evidence.sides_swapped ? mirrored(joint) : joint];
    // What was not seen is no evidence, however much it helps the fit.
    evidence.visibility[joint] = seen.told_visibility;
    evidence.disagreement[joint] = share_of_limit(seen, marked_place(body, joint, look.network),
                                                  limit_of(look.network, params));
  }
  return evidence;
}

void add_look(const BodyState& body, const ImageLook& look, unsigned parts,
              const RefinedParams& params, NormalEquations& equations) {
  const unsigned parts_and_trunk = parts | bit(Part::kTrunk);
  const SideCosts with_trunk = side_costs(body, look, parts_and_trunk, params);
  const bool swapped = with_trunk.exchanged < with_trunk.as_told;
  const SideCosts costs =
      parts == parts_and_trunk ? with_trunk : side_costs(body, look, parts, params);
  equations.cost += swapped ? costs.exchanged : costs.as_told;
  if (!equations.derivatives()) return;
  const Real sigma_m = params.image_sigma_m[static_cast<std::size_t>(look.network)];
  const Real limit_m = limit_of(look.network, params);
  const Real hips_m = hips_depth_m(body);
  for (int joint = 0; joint < kJointCount; ++joint) {
    const SeenJoint& seen = look.joints[swapped ? mirrored(joint) : joint];
    if (seen.visibility <= 0.0 || (parts & part_of(joint)) == 0) continue;
    const Vec3 point = marked_place(body, joint, look.network);
    const Real shrink = 1.0 - share_of_limit(seen, point, limit_m);
    const Real information =
        look.weight * seen.visibility * square(shrink / (sigma_m * seen.spread));
    // Two directions across the ray; along it the image tells nothing.
    const Vec3 first = seen.ray.unitOrthogonal();
    for (const Vec3& direction : {first, Vec3(seen.ray.cross(first))}) {
      equations.start_row();
      equations.derivative_of_point(joint, direction);
      equations.add_row(direction.dot(point), information);
    }
    if (look.depth_weight > 0.0)
      add_depth_row(look, seen, joint, depth_error_m(seen, point, hips_m), params, equations);
  }
}

}  // namespace

Vec3 marked_place(const BodyState& body, int joint, ImageNetwork network) {
  const Marks& marks = marks_of(network);
  Vec3 offset = marks.offsets[joint < kShoulder ? 0 : 1 + (joint - kShoulder) / 2];
  if (joint >= kShoulder) offset.x() *= side_sign((joint - kShoulder) % 2);
  if (joint == kShoulder || joint == kShoulder + 1) {
    const Vec3 upper_arm = body.points[joint + kElbow - kShoulder] - body.points[joint];
    offset.y() -= marks.shoulder_drop_m * body.rotation.col(1).dot(upper_arm.normalized());
  }
  return body.points[joint] + body.rotation * offset;
}

Real hips_depth_m(const BodyState& body) { return middle(body, kHip).z(); }

Real image_cost(const ImageLook& look, int seen_joint, const Vec3& point, Real hips_m,
                const RefinedParams& params) {
  const SeenJoint& seen = look.joints[seen_joint];
  if (seen.visibility <= 0.0) return 0.0;
  Real cost = look.weight * share_of_limit(seen, point, limit_of(look.network, params));
  if (look.depth_weight > 0.0)
    cost +=
        look.depth_weight * share_of_depth_limit(seen, depth_error_m(seen, point, hips_m), params);
  return 0.5 * seen.visibility * square(params.image_limit_sigmas) * cost;
}

std::array<ImageEvidence, kImageNetworkCount> image_evidence(const BodyState& body,
                                                             const Observation& observation,
                                                             const RefinedParams& params) {
  std::array<ImageEvidence, kImageNetworkCount> evidence;
  for (const ImageLook& look : observation.looks)
    evidence.at(static_cast<std::size_t>(look.network)) = evidence_of(body, look, params);
  return evidence;
}

bool takes_sides_otherwise(const BodyState& body, const ImageLook& look, unsigned parts,
                           const RefinedParams& params) {
  const SideCosts costs = side_costs(body, look, parts | bit(Part::kTrunk), params);
  return costs.exchanged < costs.as_told;
}

std::optional<Vec3> seen_arm_axis(const BodyState& body, const Observation& observation, int side,
                                  const std::array<ImageEvidence, kImageNetworkCount>& evidence) {
  const auto look = std::find_if(observation.looks.begin(), observation.looks.end(),
                                 [](const ImageLook& each) { return each.depth_weight > 0.0; });
  if (look == observation.looks.end()) return std::nullopt;
  const bool swapped = evidence.at(static_cast<std::size_t>(look->network)).sides_swapped;
  const auto place = [&](int joint) -> Vec3 {
    const SeenJoint& seen = look->joints[swapped ? mirrored(joint) : joint];
    return seen.ray / seen.ray.z() * (hips_depth_m(body) + seen.behind_hips_m);
  };
  return place(kWrist + side) - place(kShoulder + side);
}

void add_image_term(const BodyState& body, const Observation& observation, unsigned parts,
                    const RefinedParams& params, NormalEquations& equations) {
  for (const ImageLook& look : observation.looks) add_look(body, look, parts, params, equations);
}

}  // namespace limbcast::pose_fitter::refined
