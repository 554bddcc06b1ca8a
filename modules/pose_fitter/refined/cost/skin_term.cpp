#include <cmath>

#include "modules/pose_fitter/refined/cost/cost.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

constexpr Real kSigmaM = 0.04;
/// Gloves, shadow and long sleeves hide skin: a hand without it costs so much and no more.
constexpr Real kLimitSigmas = 2.5;
/// Place on the axis from wrist to finger tips.
constexpr Real kPlace = 0.6;

}  // namespace

void add_skin_term(const Cones& cones, const Observation& observation, unsigned parts,
                   Workspace& workspace, NormalEquations& equations) {
  if (observation.skin_distance_px.empty()) return;
  const PinholeCamera& camera = observation.camera;
  const auto distance = [&](int u, int v) {
    return static_cast<Real>(observation.skin_distance_px[observation.at(u, v)]);
  };
  for (int side = 0; side < 2; ++side) {
    if ((parts & arm_bit(side)) == 0) continue;
    const int hand = hand_cone(side);
    const Vec3 center = cones[hand].point(kPlace);
    if (center.z() < kNearestM) continue;
    const auto [u, v] = observation.pixel_of(center);
    if (!observation.inside(u - 1, v - 1) || !observation.inside(u + 1, v + 1)) continue;
    const Real residual = distance(u, v) * center.z() / camera.fx - cones[hand].radius(kPlace);
    if (residual <= 0.0) continue;
    const Real information = 1.0 / (kSigmaM * kSigmaM);
    const Real ratio = information * residual * residual / (kLimitSigmas * kLimitSigmas);
    const Real shrink = 1.0 / (1.0 + ratio);
    equations.cost += 0.5 * kLimitSigmas * kLimitSigmas * ratio * shrink;
    const Eigen::Vector3f gradient(
        static_cast<float>(0.5 * (distance(u + 1, v) - distance(u - 1, v))),
        static_cast<float>(0.5 * (distance(u, v + 1) - distance(u, v - 1))), 0.0F);
    workspace.cones.add(hand, static_cast<float>(kPlace), gradient, 0.0F,
                        static_cast<float>(residual),
                        static_cast<float>(information * shrink * shrink));
  }
}

}  // namespace limbcast::pose_fitter::refined
