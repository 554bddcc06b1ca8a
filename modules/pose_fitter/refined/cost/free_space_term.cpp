#include <algorithm>
#include <cmath>

#include "modules/pose_fitter/refined/cost/cost.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Samples on each cone's axis.
constexpr int kSamples = 4;
/// A sample must stand this share of its radius inside the silhouette: cones are a little fatter
/// than limbs at the rim, and silhouettes are ragged.
constexpr Real kRadiusShare = 0.75;
constexpr Real kClearanceSigmaM = 0.015;
constexpr Real kClearanceLimitSigmas = 10.0;
/// Where a surface that is not the person's lies less than this behind a limb, the sensor hardly
/// saw through: most likely it is the limb, cut off as somebody else's or nobody's [m]. Tuned.
constexpr float kSeenThroughM = 0.45F;
/// The skin stands this share of the radius before the axis.
constexpr Real kDepthShare = 0.8;
/// A part costs nothing where it stands less than this before the measured surface [sigmas]. Tuned.
constexpr Real kDepthSlackSigmas = 0.568;
constexpr Real kDepthSigmaM = 0.02;
constexpr Real kDepthLimitSigmas = 6.0;

/// Clearance at a pixel and its gradient [px].
struct Clearance {
  Real value = 0.0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
};

Clearance clearance_at(const Observation& observation, int u, int v) {
  const int width = observation.camera.width, height = observation.camera.height;
  const auto value = [&](int x, int y) {
    return static_cast<Real>(observation.clearance_px[observation.at(x, y)]);
  };
  if (u >= 1 && v >= 1 && u < width - 1 && v < height - 1) {
    return {value(u, v),
            {0.5 * (value(u + 1, v) - value(u - 1, v)), 0.5 * (value(u, v + 1) - value(u, v - 1))}};
  }
  // Outside the grid the clearance falls with the distance to it.
  const int nearest_u = std::clamp(u, 1, width - 2), nearest_v = std::clamp(v, 1, height - 2);
  const Eigen::Vector2d away(u - nearest_u, v - nearest_v);
  const Real distance = away.norm();
  return {std::min(0.0, value(nearest_u, nearest_v)) - distance, -away / (distance + 1e-9)};
}

struct Sample {
  int cone;
  Real t;
};

/// How a sample is held against what the sensor saw.
struct Bound {
  Real weight, sigma_m, limit_sigmas;
};

/// Whether the pixel shows a surface of something else so near behind the sample, or before it,
/// that the sensor did not see through the sample.
bool lies_at_other_surface(const Observation& observation, int u, int v, Real sample_m) {
  const std::size_t i = observation.at(u, v);
  const float measured_m = observation.measured_m[i];
  return observation.surface_m[i] <= 0.0F && measured_m > 0.0F &&
         measured_m < static_cast<float>(sample_m) + kSeenThroughM;
}

}  // namespace

void add_free_space_term(const Cones& cones, const Observation& observation, unsigned parts,
                         Real silhouette_weight, Workspace& workspace, NormalEquations& equations) {
  const PinholeCamera& camera = observation.camera;
  Real cost = 0.0;
  const auto add = [&](const Sample& sample, Real residual, const Bound& bound,
                       const Vec3& gradient) {
    const Real information = 1.0 / (bound.sigma_m * bound.sigma_m);
    const Real limit = bound.limit_sigmas;
    const Real ratio = information * residual * residual / (limit * limit),
               shrink = 1.0 / (1.0 + ratio);
    cost += bound.weight * 0.5 * limit * limit * ratio * shrink;
    workspace.cones.add(sample.cone, static_cast<float>(sample.t), gradient.cast<float>(), 0.0F,
                        static_cast<float>(residual),
                        static_cast<float>(bound.weight * information * shrink * shrink));
  };
  const Bound silhouette{silhouette_weight, kClearanceSigmaM, kClearanceLimitSigmas};
  for (int c = 0; c < kConeCount; ++c) {
    const Part part = cone_specs()[c].part;
    if ((bit(part) & parts) == 0) continue;
    // A limb's cone starts where its parent's ends.
    for (int k = part == Part::kTrunk ? 0 : 1; k <= kSamples; ++k) {
      const Sample sample{c, static_cast<Real>(k) / kSamples};
      const Vec3 center = cones[c].point(sample.t);
      if (center.z() < kNearestM) continue;
      const Real radius = cones[c].radius(sample.t);
      const auto [u, v] = observation.pixel_of(center);
      const bool inside = observation.inside(u, v);
      if (!inside && !observation.in_sensor_image(u, v)) continue;
      const Clearance clearance = clearance_at(observation, u, v);
      const Real outside = kRadiusShare * radius - clearance.value * center.z() / camera.fx;
      if (outside > 0.0 && !(inside && lies_at_other_surface(observation, u, v, center.z()))) {
        add(sample, outside, silhouette, {-clearance.gradient.x(), -clearance.gradient.y(), 0.0});
      }
      const Real surface = inside ? observation.surface_m[observation.at(u, v)] : 0.0;
      if (surface <= 0.0) continue;
      const Real sigma = kDepthSigmaM + observation.noise.sigma_m(static_cast<float>(surface));
      const Real before = surface - (center.z() - kDepthShare * radius) - kDepthSlackSigmas * sigma;
      if (before > 0.0) add(sample, before, {1.0, sigma, kDepthLimitSigmas}, {0.0, 0.0, -1.0});
    }
  }
  equations.cost += cost;
}

}  // namespace limbcast::pose_fitter::refined
