#include <algorithm>
#include <cmath>

#include "modules/pose_fitter/refined/cost/cost.hpp"
#include "modules/pose_fitter/refined/cost/image_term.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Beyond this cosine between the trunk's front and a direction it counts as turned there, between
/// the two the odds count in part: at trunks turned by 60 degrees faces get rare.
constexpr Real kTurnedCosine = 0.5;

/// Unit vectors across gravity, as the sensor looks at the person.
struct View {
  Vec3 away, right;
};

View view_of(const Observation& observation) {
  const Vec3& up = observation.up;
  const Vec3& ray = observation.head_start;
  const Vec3 away = (ray - up * up.dot(ray)).normalized();
  return {away, away.cross(up)};
}

/// 1 where a trunk is turned to a direction, -1 where it is turned away from it.
Real agreement(Real cosine) { return std::clamp(cosine / kTurnedCosine, -1.0, 1.0); }

/// What odds against a direction cost: nothing where they agree.
Real disagreement(Real log_odds, Real cosine) {
  return 0.5 * (std::abs(log_odds) - log_odds * agreement(cosine));
}

/// That none was seen tells little, as hair, masks, hats and hands hide faces: counted too, it
/// mended no body and cost a right direction (tests/accuracy).
Real seen_facing_log_odds(const FaceEvidence& face) { return std::max(0.0F, face.facing_log_odds); }

Real face_disagreement(const Vec3& front, const View& view, const FaceEvidence& face) {
  return disagreement(seen_facing_log_odds(face), -front.dot(view.away)) +
         disagreement(face.looks_right_log_odds, front.dot(view.right));
}

/// From right to left of the shoulders and hips [m]: across the ray by their marks, along it by the
/// network's own depths. Zero where none is told.
Vec3 leftwards_in_image(const ImageLook& look, Real distance_m, const View& view) {
  Vec3 leftwards = Vec3::Zero();
  if (look.network == ImageNetwork::kMoveNet) return leftwards;  // it tells no depths
  for (const int pair : {static_cast<int>(kShoulder), static_cast<int>(kHip)}) {
    const SeenJoint& left = look.joints[pair];
    const SeenJoint& right = look.joints[pair + 1];
    if (left.visibility <= 0.0 || right.visibility <= 0.0) continue;
    leftwards += distance_m * view.right.dot(left.ray - right.ray) * view.right +
                 (left.behind_hips_m - right.behind_hips_m) * view.away;
  }
  return leftwards;
}

Real image_disagreement(const Vec3& front, const View& view, const Observation& observation,
                        Real side_log_odds) {
  Real sum = 0.0;
  for (const ImageLook& look : observation.looks) {
    const Vec3 leftwards = leftwards_in_image(look, observation.head_start.norm(), view);
    if (leftwards.isZero()) continue;
    const Vec3 told = leftwards.cross(observation.up).normalized();
    // Of a trunk seen from the front or from behind the marks alone tell the sides: the image term.
    const Real sideways = told.dot(view.right);
    sum += disagreement(side_log_odds * sideways * sideways, front.dot(told));
  }
  return sum;
}

/// Whether the network sees the back of somebody whose face is in plain sight.
bool misses_a_plain_face(const ImageLook& look, const View& view, const Observation& observation,
                         const RefinedParams& params) {
  if (seen_facing_log_odds(observation.face) <= params.plain_face_log_odds) return false;
  const Vec3 leftwards = leftwards_in_image(look, observation.head_start.norm(), view);
  return leftwards.cross(observation.up).dot(view.away) > 0.0;
}

/// What speaks against a body whose left the network of depths sees on the right.
Real depth_disagreement(const BodyState& body, const View& view, const Observation& observation,
                        const RefinedParams& params) {
  const auto distance_m = static_cast<float>(observation.head_start.z());
  if (observation.noise.sigma_m(distance_m) > params.depth_side_most_noise_m) return 0.0;
  for (const ImageLook& look : observation.looks) {
    if (look.network == ImageNetwork::kDepthPose &&
        takes_sides_otherwise(body, look, kAllParts, params) &&
        !misses_a_plain_face(look, view, observation, params))
      return params.depth_side_log_odds;
  }
  return 0.0;
}

}  // namespace

Real face_agreement(const Vec3& front, const Observation& observation) {
  return seen_facing_log_odds(observation.face) * agreement(-front.dot(view_of(observation).away));
}

Real sideways(const Vec3& front, const Observation& observation) {
  return std::abs(front.dot(view_of(observation).right));
}

Real front_cost(const BodyState& body, const Observation& observation,
                const RefinedParams& params) {
  const View view = view_of(observation);
  const Vec3 front = body.front();
  return params.front_cost_per_log_odds *
         (face_disagreement(front, view, observation.face) +
          image_disagreement(front, view, observation, params.image_side_log_odds) +
          depth_disagreement(body, view, observation, params));
}

}  // namespace limbcast::pose_fitter::refined
