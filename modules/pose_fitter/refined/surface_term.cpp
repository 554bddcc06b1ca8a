#include <cmath>

#include "modules/pose_fitter/refined/cost.hpp"

namespace limbcast::pose_fitter::refined {

void add_surface_term(const Cones& cones, const FitStage& stage, Real robust_sigmas,
                      Workspace& workspace, NormalEquations& equations) {
  const PointColumns& points = *stage.points;
  NearestCones& nearest = workspace.nearest;
  nearest_cones(points, cones, stage.parts, stage.fixed, nearest);
  const bool derivatives = equations.derivatives();
  const Real limit2 = robust_sigmas * robust_sigmas,
             sigma2 = stage.surface_sigma_m * stage.surface_sigma_m;
  Real cost = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Cone& cone = cones[nearest.cone[i]];
    const Vec3 point(points.x[i], points.y[i], points.z[i]);
    const Real t = nearest.place[i], residual = nearest.distance[i];
    const Vec3 normal = (point - cone.point(t)) / (residual + cone.radius(t) + 1e-9);
    // The sensor's error is along the ray: it counts as far as the surface faces the sensor.
    const Real along_ray2 = std::pow(normal.dot(point), 2) / point.squaredNorm();
    const Real variance = sigma2 + along_ray2 * points.sigma_m[i] * points.sigma_m[i];
    const Real ratio = residual * residual / (variance * limit2), shrink = 1.0 / (1.0 + ratio);
    cost += points.weight[i] * 0.5 * limit2 * ratio * shrink;
    if (!derivatives || (bit(cone_specs()[nearest.cone[i]].part) & stage.parts) == 0) continue;
    workspace.cones.add(nearest.cone[i], t, -normal, cone.radius(t), residual,
                        points.weight[i] * shrink * shrink / variance);
  }
  equations.cost += cost;
}

}  // namespace limbcast::pose_fitter::refined
