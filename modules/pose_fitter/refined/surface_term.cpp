#include <cmath>

#include "modules/pose_fitter/refined/cost.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

struct FloatCone {
  Eigen::Vector3f from, axis;
  float radius_from, radius_change;
  bool fitted;
};

FloatCone to_float(const Cone& cone, unsigned parts, int index) {
  return {cone.from.cast<float>(), cone.axis.cast<float>(), static_cast<float>(cone.radius_from),
          static_cast<float>(cone.radius_change), (bit(cone_specs()[index].part) & parts) != 0};
}

}  // namespace

void add_surface_term(const Cones& cones, const FitStage& stage, Real robust_sigmas,
                      Workspace& workspace, NormalEquations& equations) {
  const PointColumns& points = *stage.points;
  NearestCones& nearest = workspace.nearest;
  nearest_cones(points, cones, stage.parts, stage.fixed, nearest);
  const float limit2 = static_cast<float>(robust_sigmas * robust_sigmas);
  const float sigma2 = static_cast<float>(stage.surface_sigma_m * stage.surface_sigma_m);
  std::array<FloatCone, kConeCount> float_cones;
  for (int c = 0; c < kConeCount; ++c) float_cones[c] = to_float(cones[c], stage.parts, c);
  float cost = 0.0F;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const FloatCone& cone = float_cones[nearest.cone[i]];
    const Eigen::Vector3f point(points.x[i], points.y[i], points.z[i]);
    const float t = nearest.place[i], residual = nearest.distance[i];
    const float radius = cone.radius_from + cone.radius_change * t;
    const Eigen::Vector3f normal =
        (point - cone.from - t * cone.axis) * (1.0F / (residual + radius + 1e-6F));
    // The sensor's error is along the ray: it counts as far as the surface faces the sensor.
    const float toward = normal.dot(point), sensor = points.sigma_m[i];
    const float variance = sigma2 + toward * toward / point.squaredNorm() * sensor * sensor;
    const float ratio = residual * residual / (variance * limit2), shrink = 1.0F / (1.0F + ratio);
    cost += points.weight[i] * 0.5F * limit2 * ratio * shrink;
    if (!cone.fitted) continue;
    workspace.cones.add(nearest.cone[i], t, -normal, radius, residual,
                        points.weight[i] * shrink * shrink / variance);
  }
  equations.cost += cost;
}

}  // namespace limbcast::pose_fitter::refined
