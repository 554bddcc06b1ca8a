#include "modules/pose_fitter/refined/search/straight_arm.hpp"

#include "common/angle.hpp"
#include "modules/pose_fitter/refined/search/arm_search.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// From this bend of the elbow on an arm is bent, and up to the other straight [deg]: arms that
/// point are bent by up to 20, fitted with an error of up to 15.
constexpr Real kBentElbowDeg = 35.0, kStraightElbowDeg = 30.0;
/// Least angle between the line shoulder-wrist and the trunk of a raised arm [deg].
constexpr Real kRaisedArmDeg = 45.0;

Vec3 upper_arm(const BodyState& body, int side) {
  return body.points[kElbow + side] - body.points[kShoulder + side];
}

Vec3 forearm(const BodyState& body, int side) {
  return body.points[kWrist + side] - body.points[kElbow + side];
}

Real elbow_bend_deg(const BodyState& body, int side) {
  return angle_deg(upper_arm(body, side), forearm(body, side));
}

Real arm_raise_deg(const BodyState& body, int side) {
  return angle_deg(body.points[kWrist + side] - body.points[kShoulder + side],
                   body.points[kPelvis] - body.points[kNeck]);
}

BodyState with_arm_along(BodyState body, int side, const Vec3& direction) {
  const Vec3 elbow = body.points[kShoulder + side] + upper_arm(body, side).norm() * direction;
  set_arm(body, side, {0.0, elbow, elbow + forearm(body, side).norm() * direction});
  return body;
}

}  // namespace

std::vector<BodyState> with_straight_arm(const BodyState& body, int side) {
  std::vector<BodyState> straight;
  if (elbow_bend_deg(body, side) < kBentElbowDeg) return straight;
  const Vec3 upper = upper_arm(body, side), fore = forearm(body, side);
  for (const Vec3& along : {Vec3(upper + fore), upper, fore})
    straight.push_back(with_arm_along(body, side, along.normalized()));
  return straight;
}

bool is_straight_and_raised(const BodyState& body, int side) {
  return elbow_bend_deg(body, side) <= kStraightElbowDeg &&
         arm_raise_deg(body, side) >= kRaisedArmDeg;
}

}  // namespace limbcast::pose_fitter::refined
