#include "modules/pose_fitter/refined/confidence/person_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/spread.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// In the order of cone_specs().
constexpr std::array<Region, kConeCount> kRegionOfCone = {
    Region::kHead,      Region::kShoulders, Region::kShoulders, Region::kChest,    Region::kBelly,
    Region::kShoulders, Region::kChest,     Region::kBelly,     Region::kChest,    Region::kBelly,
    Region::kUpperArms, Region::kForearms,  Region::kForearms,  Region::kThighs,   Region::kShins,
    Region::kShins,     Region::kUpperArms, Region::kForearms,  Region::kForearms, Region::kThighs,
    Region::kShins,     Region::kShins};

/// Samples along a cone's axis, and across it in radii.
constexpr int kSamplesAlong = 4;
constexpr std::array<Real, 3> kSamplesAcross = {-0.7, 0.0, 0.7};
/// Samples beside the outline stand this many radii and metres off the axis: clear of clothes and
/// of a ragged silhouette.
constexpr Real kBesideRadii = 1.3, kBesideM = 0.03;
/// A surface this near to the expected one is that one [m], and two sigmas of the depth's noise:
/// on the body, where clothes and muscles differ; beside it, where the body's depth is meant.
constexpr Real kOnSurfaceM = 0.06, kLevelM = 0.12, kNoiseSigmas = 2.0;
/// Cones that point at the sensor more than this have no outline: sine of the angle to the ray.
constexpr Real kLeastSine = 0.3;
/// Spread of the surface about the cones [m]; points farther off than 2.5 of these are unexplained,
/// 1.5 inside the body: through it. Squared distances over the most tell nothing more.
constexpr Real kSurfaceSigmaM = 0.02, kUnexplainedM = 0.05, kInsideM = 0.03, kMostMisfit = 9.0;

/// Ankles and lowest points of an adult who stands on a floor that is not known [m].
constexpr Real kUsualBottomM = 0.08;

std::size_t index_of(Region region) { return static_cast<std::size_t>(region); }

/// What was measured at a pixel.
struct Measured {
  Real z_m = 0.0;  ///< 0: nothing
  bool own = false;
};

/// At the pixel of `point` or, where nothing was measured there, at one beside it.
Measured measured_at(const Observation& observation, const Vec3& point) {
  static constexpr std::array<std::array<int, 2>, 9> kNearestFirst = {
      {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
  if (point.z() < kNearestM) return {};
  const auto [u, v] = observation.pixel_of(point);
  for (const auto& [du, dv] : kNearestFirst) {
    if (!observation.inside(u + du, v + dv)) continue;
    const std::size_t i = observation.at(u + du, v + dv);
    if (observation.measured_m[i] > 0.0F)
      return {observation.measured_m[i], observation.surface_m[i] > 0.0F};
  }
  return {};
}

/// True where the sensor sees another cone than `but` at the ray of `point`, or nearly so.
bool is_covered(const Vec3& point, const Cones& cones, int but) {
  const Vec3 ray = point.normalized();
  for (int c = 0; c < kConeCount; ++c) {
    if (c == but) continue;
    const Real t = cones[c].nearest(point);
    const Vec3 offset = point - cones[c].point(t);
    if ((offset - offset.dot(ray) * ray).norm() < cones[c].radius(t) + kBesideM) return true;
  }
  return false;
}

/// Looks at one sample after the other.
class RegionSums {
 public:
  void add_on_surface(const Measured& measured, Real expected_z_m, Real noise_m) {
    ++samples_;
    count(measured, expected_z_m, kOnSurfaceM + kNoiseSigmas * noise_m, look_.before,
          measured.own ? look_.own : look_.other, look_.behind);
  }

  void add_beside(const Measured& measured, Real expected_z_m, Real noise_m) {
    ++samples_beside_;
    count(measured, expected_z_m, kLevelM + kNoiseSigmas * noise_m, look_.beside_before,
          look_.beside_level, look_.beside_behind);
  }

  RegionLook shares() const {
    RegionLook look = look_;
    for (Real* count : {&look.own, &look.other, &look.before, &look.behind})
      *count /= std::max(1, samples_);
    for (Real* count : {&look.beside_behind, &look.beside_level, &look.beside_before})
      *count /= std::max(1, samples_beside_);
    return look;
  }

 private:
  /// One more where the measured depth lies: before the expected one, at it, or behind.
  static void count(const Measured& measured, Real expected_z_m, Real tolerance_m, Real& before,
                    Real& level, Real& behind) {
    if (measured.z_m <= 0.0) return;
    if (measured.z_m < expected_z_m - tolerance_m)
      ++before;
    else if (measured.z_m > expected_z_m + tolerance_m)
      ++behind;
    else
      ++level;
  }

  RegionLook look_;  ///< counts
  int samples_ = 0, samples_beside_ = 0;
};

void look_around_cone(int c, const Cones& cones, const Observation& observation, RegionSums& sums) {
  const Cone& cone = cones[c];
  for (int k = 0; k < kSamplesAlong; ++k) {
    const Real t = (k + 0.5) / kSamplesAlong;
    const Vec3 center = cone.point(t);
    if (center.z() < kNearestM) continue;
    const Vec3 ray = center.normalized();
    Vec3 across = ray.cross(cone.axis);
    if (across.norm() < kLeastSine * cone.axis.norm()) continue;
    across.normalize();
    const Real radius = cone.radius(t);
    const Real noise_m = observation.noise.sigma_m(static_cast<float>(center.z()));
    for (const Real s : kSamplesAcross) {
      const Vec3 point = center + radius * (s * across - std::sqrt(1.0 - s * s) * ray);
      sums.add_on_surface(measured_at(observation, point), point.z(), noise_m);
    }
    for (const Real side : {-1.0, 1.0}) {
      const Vec3 point = center + side * (kBesideRadii * radius + kBesideM) * across;
      if (is_covered(point, cones, c)) continue;
      sums.add_beside(measured_at(observation, point), point.z(), noise_m);
    }
  }
}

bool of_trunk(Region region) {
  return region == Region::kShoulders || region == Region::kChest || region == Region::kBelly;
}

/// What the person's points are like, and what the body explains of them.
void look_at_points(const BodyState& body, const Cones& cones, const Observation& observation,
                    PersonEvidence& evidence) {
  const PointColumns& points = observation.fine;
  NearestCones nearest;
  nearest_cones(points, cones, kAllParts, nullptr, nearest);
  Spread all, trunk;
  Real weight = 0.0, top_m = -std::numeric_limits<Real>::max(), bottom_m = -top_m;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Real point_weight = points.weight[i], distance_m = nearest.distance[i];
    const Real noise_m = points.sigma_m[i];
    const Region region = kRegionOfCone[static_cast<std::size_t>(nearest.cone[i])];
    RegionLook& look = evidence.regions[index_of(region)];
    weight += point_weight;
    look.weight_share += point_weight;
    const Real sigmas = distance_m / std::hypot(kSurfaceSigmaM, noise_m);
    look.misfit += point_weight * std::min(kMostMisfit, sigmas * sigmas);
    if (std::abs(distance_m) > kUnexplainedM + kNoiseSigmas * noise_m)
      evidence.unexplained_share += point_weight;
    if (distance_m < -kInsideM - kNoiseSigmas * noise_m) evidence.inside_share += point_weight;
    const Vec3 point(points.x[i], points.y[i], points.z[i]);
    const Vec3 from_chest = point - body.points[kChest];
    all.add(from_chest, point_weight);
    if (of_trunk(region)) trunk.add(from_chest, point_weight);
    top_m = std::max(top_m, point.dot(observation.up));
    bottom_m = std::min(bottom_m, point.dot(observation.up));
  }
  for (RegionLook& look : evidence.regions) {
    if (look.weight_share <= 0.0) continue;
    look.misfit /= look.weight_share;
    look.weight_share /= weight;
  }
  evidence.unexplained_share /= weight;
  evidence.inside_share /= weight;
  evidence.extent_m = all.extent();
  evidence.trunk_extent_m = trunk.extent();
  evidence.top_over_head_m = top_m - body.points[kHead].dot(observation.up);
  evidence.bottom_m = observation.floor_m ? bottom_m + *observation.floor_m : kUsualBottomM;
}

Real mean_cosine(const Observation& observation, const BodyState& body, int upper, int lower) {
  Real sum = 0.0;
  for (int side = 0; side < 2; ++side)
    sum += observation.up.dot((body.points[upper + side] - body.points[lower + side]).normalized());
  return 0.5 * sum;
}

Real share_outside(const BodyState& body, const Observation& observation) {
  const auto outside =
      std::count_if(body.points.begin(), body.points.begin() + kJointCount, [&](const Vec3& point) {
        if (point.z() < kNearestM) return false;
        const auto [u, v] = observation.pixel_of(point);
        return !observation.in_sensor_image(u, v);
      });
  return static_cast<Real>(outside) / kJointCount;
}

void look_at_posture(const BodyState& body, const Observation& observation,
                     PersonEvidence& evidence) {
  const Vec3 &head = body.points[kHead], &up = observation.up;
  const Vec3 ankles = 0.5 * (body.points[kAnkle] + body.points[kAnkle + 1]);
  evidence.ankle_height_m =
      observation.floor_m ? ankles.dot(up) + *observation.floor_m : kUsualBottomM;
  evidence.noise_m = observation.noise.sigma_m(static_cast<float>(head.z()));
  evidence.head_moved_m = (head - observation.head_start).norm();
  evidence.outside_share = share_outside(body, observation);
  evidence.trunk_upright = up.dot(body.rotation.col(1));
  evidence.neck_upright = up.dot((head - body.points[kNeck]).normalized());
  evidence.thighs_upright = mean_cosine(observation, body, kHip, kKnee);
  evidence.shins_upright = mean_cosine(observation, body, kKnee, kAnkle);
}

}  // namespace

PersonEvidence gather_person_evidence(const BodyState& body, const Observation& observation) {
  const Cones cones = make_cones_of(body);
  std::array<RegionSums, kRegionCount> sums;
  for (int c = 0; c < kConeCount; ++c)
    look_around_cone(c, cones, observation, sums[index_of(kRegionOfCone[c])]);
  PersonEvidence evidence;
  for (int r = 0; r < kRegionCount; ++r) evidence.regions[r] = sums[r].shares();
  look_at_points(body, cones, observation, evidence);
  look_at_posture(body, observation, evidence);
  evidence.face_log_odds = std::max(0.0F, observation.face.facing_log_odds);
  evidence.guessed_head = observation.guessed_head;
  return evidence;
}

}  // namespace limbcast::pose_fitter::refined
