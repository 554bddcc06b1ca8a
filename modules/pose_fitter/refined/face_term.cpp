#include <algorithm>
#include <cmath>

#include "modules/pose_fitter/refined/cost.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Beyond this cosine between the trunk's front and a direction it counts as turned there, between
/// the two the odds count in part: at trunks turned by 60 degrees faces get rare.
constexpr Real kTurnedCosine = 0.5;

/// What odds against a direction cost: nothing where they agree.
Real disagreement(Real log_odds, Real cosine) {
  const Real agreement = std::clamp(cosine / kTurnedCosine, -1.0, 1.0);
  return 0.5 * (std::abs(log_odds) - log_odds * agreement);
}

}  // namespace

Real face_cost(const BodyState& body, const Observation& observation, Real cost_per_log_odds) {
  const Vec3& up = observation.up;
  const Vec3& ray = observation.head_start;
  const Vec3 away = (ray - up * up.dot(ray)).normalized();
  const Vec3 right = away.cross(up);
  const Vec3 front = body.front();
  // That none was seen tells little, as hair, masks, hats and hands hide faces: counted too, it
  // mended no body and cost a right direction (tests/accuracy).
  const Real facing_log_odds = std::max(0.0F, observation.face.facing_log_odds);
  return cost_per_log_odds *
         (disagreement(facing_log_odds, -front.dot(away)) +
          disagreement(observation.face.looks_right_log_odds, front.dot(right)));
}

}  // namespace limbcast::pose_fitter::refined
