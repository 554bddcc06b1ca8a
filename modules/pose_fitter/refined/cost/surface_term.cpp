#include "common/simd.hpp"
#include "modules/pose_fitter/refined/cost/cost.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Cones in the points' precision, each number in a column of its own.
struct ConeColumns {
  explicit ConeColumns(const Cones& cones) {
    for (int c = 0; c < kConeCount; ++c) {
      const Eigen::Vector3f from = cones[c].from.cast<float>(), axis = cones[c].axis.cast<float>();
      from_x[c] = from.x();
      from_y[c] = from.y();
      from_z[c] = from.z();
      axis_x[c] = axis.x();
      axis_y[c] = axis.y();
      axis_z[c] = axis.z();
      radius_from[c] = static_cast<float>(cones[c].radius_from);
      radius_change[c] = static_cast<float>(cones[c].radius_change);
    }
  }

  std::array<float, kConeCount> from_x, from_y, from_z, axis_x, axis_y, axis_z, radius_from,
      radius_change;
};

/// Robust costs of the points and the rows of their residuals.
LIMBCAST_SIMD void weigh_points(const PointColumns& points, const ConeColumns& cones,
                                const NearestCones& nearest, float sigma2, float limit2,
                                ConeEquations::Columns& rows, std::vector<float>& costs) {
  const float* const point_x = points.x.data();
  const float* const point_y = points.y.data();
  const float* const point_z = points.z.data();
  const float* const weight = points.weight.data();
  const float* const sigma_m = points.sigma_m.data();
  const float* const place = nearest.place.data();
  const float* const distance = nearest.distance.data();
  const std::int32_t* const nearest_cone = nearest.cone.data();
  float* const row_x = rows.x.data();
  float* const row_y = rows.y.data();
  float* const row_z = rows.z.data();
  float* const row_radius = rows.radius.data();
  float* const information = rows.information.data();
  float* const cost = costs.data();
  const std::size_t count = points.size();
  LIMBCAST_INDEPENDENT_ROUNDS
  for (std::size_t i = 0; i < count; ++i) {
    const float x = point_x[i], y = point_y[i], z = point_z[i];
    const float t = place[i], residual = distance[i];
    const std::int32_t c = nearest_cone[i];
    const float radius = cones.radius_from[c] + cones.radius_change[c] * t;
    const float shorten = 1.0F / (residual + radius + 1e-6F);
    const float normal_x = (x - cones.from_x[c] - t * cones.axis_x[c]) * shorten,
                normal_y = (y - cones.from_y[c] - t * cones.axis_y[c]) * shorten,
                normal_z = (z - cones.from_z[c] - t * cones.axis_z[c]) * shorten;
    // The sensor's error is along the ray: it counts as far as the surface faces the sensor.
    const float toward = normal_x * x + (normal_y * y + normal_z * z), sensor = sigma_m[i];
    const float variance = sigma2 + toward * toward / (x * x + (y * y + z * z)) * sensor * sensor;
    const float ratio = residual * residual / (variance * limit2), shrink = 1.0F / (1.0F + ratio);
    cost[i] = weight[i] * 0.5F * limit2 * ratio * shrink;
    row_radius[i] = radius;
    row_x[i] = -normal_x;
    row_y[i] = -normal_y;
    row_z[i] = -normal_z;
    information[i] = weight[i] * shrink * shrink / variance;
  }
}

}  // namespace

void add_surface_term(const Cones& cones, const FitStage& stage, Real robust_sigmas,
                      Workspace& workspace, NormalEquations& equations) {
  const PointColumns& points = *stage.points;
  NearestCones& nearest = workspace.nearest;
  nearest_cones(points, cones, stage.parts, stage.fixed, nearest);
  ConeEquations::Columns& rows = workspace.cones.many();
  rows.resize(points.size());
  workspace.costs.resize(points.size());
  weigh_points(points, ConeColumns(cones), nearest,
               static_cast<float>(stage.surface_sigma_m * stage.surface_sigma_m),
               static_cast<float>(robust_sigmas * robust_sigmas), rows, workspace.costs);
  float cost = 0.0F;
  for (std::size_t i = 0; i < points.size(); ++i) {
    cost += workspace.costs[i];
    const int cone = nearest.cone[i];
    const bool fitted = (bit(cone_specs()[cone].part) & stage.parts) != 0;
    rows.cone[i] = fitted ? cone : -1;
    rows.t[i] = nearest.place[i];
    rows.residual[i] = nearest.distance[i];
  }
  equations.cost += cost;
}

}  // namespace limbcast::pose_fitter::refined
