#include "modules/pose_fitter/refined/search/arm_samples.hpp"

#include "common/simd.hpp"
#include "modules/pose_fitter/refined/cost/cost.hpp"

// Choices between numbers, not between ways: which way a sample goes cannot be foreseen, and
// several go at once.
namespace limbcast::pose_fitter::refined {
namespace {

/// A sample that cannot be: cost.
constexpr Real kImpossible = 4.0;
constexpr Real kOutsideImage = 0.8, kInHole = 0.5;
constexpr Real kUnexplainedReward = 1.5;
/// A sphere of so much of the limb's radius must be free of what was seen through, with this spread
/// [m].
constexpr Real kFreeRadii = 0.6, kFreeSigmaM = 0.03;
/// The surface stands so many radii before the limb's axis.
constexpr Real kSurfaceRadii = 0.85;
/// Square of the sigmas within which a surface is the limb's own.
constexpr Real kOwnSigmas2 = 4.0;
/// A limb behind what is seen may be hidden: its cost rises so much more slowly, up to this.
constexpr Real kHiddenSlope = 0.6, kHidden = 1.0;

LIMBCAST_SIMD void project(const Observation& observation, ArmSamples& samples) {
  // Adding this leaves no digits behind the point.
  constexpr Real kRounder = 6755399441055744.0;
  const PinholeCamera& camera = observation.camera;
  const Real fx = camera.fx, fy = camera.fy, cx = camera.cx, cy = camera.cy;
  const Real width = camera.width, height = camera.height;
  const Real left = -observation.origin_u, top = -observation.origin_v;
  const Real right = left + observation.full_width, bottom = top + observation.full_height;
  const Real* const x = samples.x.data();
  const Real* const y = samples.y.data();
  const Real* const z = samples.z.data();
  Real* const pixel_u = samples.u.data();
  Real* const pixel_v = samples.v.data();
  Real* const elsewhere = samples.elsewhere.data();
  const std::size_t count = samples.size();
  LIMBCAST_INDEPENDENT_ROUNDS
  for (std::size_t i = 0; i < count; ++i) {
    const Real inverse_z = 1.0 / z[i];
    const Real u = fx * x[i] * inverse_z + cx + kRounder - kRounder;
    const Real v = fy * y[i] * inverse_z + cy + kRounder - kRounder;
    const bool in_grid = (u >= 0.0) & (v >= 0.0) & (u < width) & (v < height);
    const bool in_image = (u >= left) & (v >= top) & (u < right) & (v < bottom);
    const bool before = z[i] >= kNearestM;
    const Real beyond = in_image ? kImpossible : kOutsideImage;
    const Real nowhere = (in_image & in_grid) ? 0.0 : beyond;
    elsewhere[i] = before ? nowhere : kImpossible;
    pixel_u[i] = in_grid ? u : 0.0;
    pixel_v[i] = in_grid ? v : 0.0;
  }
}

}  // namespace

void ArmSamples::clear() {
  for (auto* column : {&x, &y, &z, &radius}) column->clear();
}

void ArmSamples::add(const Vec3& center, Real radius_m) {
  x.push_back(center.x());
  y.push_back(center.y());
  z.push_back(center.z());
  radius.push_back(radius_m);
}

void find_pixels(const Observation& observation, ArmSamples& samples) {
  for (auto* column : {&samples.u, &samples.v, &samples.elsewhere, &samples.clearance_px,
                       &samples.surface_m, &samples.sigma_m, &samples.unexplained, &samples.cost})
    column->resize(samples.size());
  project(observation, samples);
}

LIMBCAST_SIMD void weigh(Real fx_px, ArmSamples& samples) {
  const Real* const z = samples.z.data();
  const Real* const radius = samples.radius.data();
  const Real* const clearance_px = samples.clearance_px.data();
  const Real* const surface = samples.surface_m.data();
  const Real* const sigma = samples.sigma_m.data();
  const Real* const unexplained = samples.unexplained.data();
  const Real* const elsewhere = samples.elsewhere.data();
  Real* const cost = samples.cost.data();
  const std::size_t count = samples.size();
  LIMBCAST_INDEPENDENT_ROUNDS
  for (std::size_t i = 0; i < count; ++i) {
    const Real outside = (kFreeRadii * radius[i] - clearance_px[i] * z[i] / fx_px) / kFreeSigmaM;
    const Real outside2 = outside * outside;
    const Real capped = outside2 < kImpossible ? outside2 : kImpossible;
    const Real outside_cost = outside > 0.0 ? capped : 0.0;
    const Real behind = z[i] - kSurfaceRadii * radius[i] - surface[i];
    const Real sigmas2 = behind * behind / (sigma[i] * sigma[i]);
    const Real before_cost = sigmas2 < kImpossible ? sigmas2 : kImpossible;
    const Real slope = kHiddenSlope * sigmas2, behind_cost = slope < kHidden ? slope : kHidden;
    const Real reward = kUnexplainedReward * unexplained[i] * (1.0 - sigmas2 / kOwnSigmas2);
    const Real on_ray_cost = behind < 0.0 ? before_cost : behind_cost;
    const Real seen_cost = outside_cost + on_ray_cost - (sigmas2 < kOwnSigmas2 ? reward : 0.0);
    const Real grid_cost = surface[i] > 0.0 ? seen_cost : outside_cost + kInHole;
    cost[i] = elsewhere[i] > 0.0 ? elsewhere[i] : grid_cost;
  }
}

}  // namespace limbcast::pose_fitter::refined
