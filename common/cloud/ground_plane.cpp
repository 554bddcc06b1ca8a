#include "common/cloud/ground_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "common/formatted.hpp"
#include "common/spread.hpp"

namespace limbcast {
namespace {

/// Points of a thinned cloud, each with the distance that its noise makes along the ray.
struct Sample {
  std::vector<float> x, y, z, noise;
  std::size_t size() const { return x.size(); }
  Eigen::Vector3f point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void add(const Eigen::Vector3f& point_m, const DepthNoise& depth_noise) {
    const float distance_m = std::max(point_m.norm(), 1e-3F);
    x.push_back(point_m.x());
    y.push_back(point_m.y());
    z.push_back(point_m.z());
    // The error is along the ray, so across a plane at height h it is sigma * h / distance.
    noise.push_back(2.0F * depth_noise.sigma_m(distance_m) / distance_m);
  }
};

struct Plane {
  Eigen::Vector3f down;
  float height_m;
};

struct Support {
  int inliers = 0, below = 0;
  int score() const { return inliers - 2 * below; }
};

Sample thin(const Cloud& cloud, const GroundPlaneParams& params) {
  Sample sample;
  const std::size_t wanted = std::max(1, params.sample_size);
  const auto is_near = [&](std::size_t index) {
    return cloud.points_m[index].norm() <= static_cast<float>(params.max_distance_m);
  };
  if (cloud.organized()) {
    const double share = static_cast<double>(cloud.points_m.size()) / static_cast<double>(wanted);
    const int step = std::max(1, static_cast<int>(std::sqrt(share)));
    for (int v = step / 2; v < cloud.height; v += step) {
      for (int u = step / 2; u < cloud.width; u += step) {
        const std::size_t index = static_cast<std::size_t>(v) * cloud.width + u;
        if (!cloud.is_hole(index) && is_near(index))
          sample.add(cloud.points_m[index], cloud.stamp.depth_noise);
      }
    }
    return sample;
  }
  std::vector<std::size_t> near;
  near.reserve(cloud.points_m.size());
  for (std::size_t index = 0; index < cloud.points_m.size(); ++index) {
    if (is_near(index)) near.push_back(index);
  }
  // The order of an unorganised cloud may be that of the scan, so an even step could meet one ring
  // only.
  std::minstd_rand random(1);
  const std::size_t count = std::min(wanted, near.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = near[count == near.size() ? i : random() % near.size()];
    sample.add(cloud.points_m[index], cloud.stamp.depth_noise);
  }
  return sample;
}

Support count_support(const Sample& sample, std::size_t step, const Plane& plane, float inlier_m) {
  Support support;
  for (std::size_t i = 0; i < sample.size(); i += step) {
    const float beyond_m = plane.down.x() * sample.x[i] + plane.down.y() * sample.y[i] +
                           plane.down.z() * sample.z[i] - plane.height_m;
    const float tolerance_m = inlier_m + sample.noise[i] * plane.height_m;
    support.inliers += static_cast<int>(std::abs(beyond_m) <= tolerance_m);
    support.below += static_cast<int>(beyond_m > 2.0F * tolerance_m);
  }
  return support;
}

std::optional<Plane> plane_through(const std::array<Eigen::Vector3f, 3>& points,
                                   const Eigen::Vector3f& down, const GroundPlaneParams& params) {
  Eigen::Vector3f normal = (points[1] - points[0]).cross(points[2] - points[0]);
  const float norm = normal.norm();
  if (norm < 1e-4F) return std::nullopt;
  normal /= normal.dot(down) > 0.0F ? norm : -norm;
  const float height_m = normal.dot(points[0]);
  if (normal.dot(down) < std::cos(params.max_tilt_rad) || height_m < params.min_height_m ||
      height_m > params.max_height_m)
    return std::nullopt;
  return Plane{normal, height_m};
}

/// The best of many planes through three points each: ranked on a tenth of the sample, the first
/// ones on all.
std::optional<Plane> search(const Sample& sample, const Eigen::Vector3f& down, int draws,
                            const GroundPlaneParams& params) {
  constexpr std::size_t kCoarseStep = 10;
  constexpr std::size_t kFinalists = 24;
  const auto inlier_m = static_cast<float>(params.inlier_distance_m);
  std::vector<std::pair<int, Plane>> candidates;
  std::minstd_rand random(1);
  for (int i = 0; i < draws; ++i) {
    std::array<Eigen::Vector3f, 3> points;
    for (Eigen::Vector3f& point : points) point = sample.point(random() % sample.size());
    const auto plane = plane_through(points, down, params);
    if (plane)
      candidates.emplace_back(count_support(sample, kCoarseStep, *plane, inlier_m).score(), *plane);
  }
  const auto better = [](const auto& a, const auto& b) { return a.first > b.first; };
  std::stable_sort(candidates.begin(), candidates.end(), better);
  if (candidates.size() > kFinalists) candidates.resize(kFinalists);
  for (auto& [score, plane] : candidates) score = count_support(sample, 1, plane, inlier_m).score();
  const auto best =
      std::max_element(candidates.begin(), candidates.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
  if (best == candidates.end()) return std::nullopt;
  return best->second;
}

/// Least squares plane through the points near `plane`, and how far they spread along it.
struct Refined {
  Plane plane;
  double extent_m;
};
std::optional<Refined> refine(const Sample& sample, const Plane& plane, float inlier_m) {
  Spread spread;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const Eigen::Vector3f point = sample.point(i);
    if (std::abs(plane.down.dot(point) - plane.height_m) >
        inlier_m + sample.noise[i] * plane.height_m)
      continue;
    spread.add(point.cast<double>());
  }
  constexpr double kLeastPoints = 10.0;
  if (spread.weight() < kLeastPoints) return std::nullopt;
  const auto axes = spread.principal_axes();
  Eigen::Vector3f normal = axes.eigenvectors().col(0).cast<float>();
  if (normal.dot(plane.down) < 0.0F) normal = -normal;
  return Refined{{normal, normal.dot(spread.mean().cast<float>())},
                 std::sqrt(std::max(0.0, axes.eigenvalues()[1]))};
}

/// 0.5 where a measured figure only just reaches its limit, towards 1 the farther it lies beyond.
double clearness(double measured, double limit) { return measured / (measured + limit); }

double confidence_of(const Support& support, double inlier_share, double extent_m,
                     const GroundPlaneParams& params) {
  const double below_share = static_cast<double>(support.below) / support.inliers;
  return std::min({clearness(inlier_share, params.min_inlier_share),
                   clearness(extent_m, params.min_extent_m),
                   clearness(params.max_below_share, below_share)});
}

std::optional<GroundPlane> find_in(const Sample& sample, const Eigen::Vector3f& down, int draws,
                                   const GroundPlaneParams& params) {
  std::optional<Plane> plane = search(sample, down, draws, params);
  if (!plane) return std::nullopt;
  const auto inlier_m = static_cast<float>(params.inlier_distance_m);
  double extent_m = 0.0;
  for (int round = 0; round < 3; ++round) {
    const auto refined = refine(sample, *plane, inlier_m);
    if (!refined) return std::nullopt;
    plane = refined->plane;
    extent_m = refined->extent_m;
  }
  const Support support = count_support(sample, 1, *plane, inlier_m);
  const auto share = static_cast<float>(support.inliers) / static_cast<float>(sample.size());
  const double of_full_extent =
      extent_m < params.full_extent_m ? extent_m / params.full_extent_m : 1.0;
  const double most_below = params.max_below_share * of_full_extent * support.inliers;
  if (share < params.min_inlier_share || support.below > most_below ||
      extent_m < params.min_extent_m || plane->height_m < params.min_height_m ||
      plane->down.dot(down) < std::cos(params.max_tilt_rad))
    return std::nullopt;
  const auto confidence = static_cast<float>(confidence_of(support, share, extent_m, params));
  return GroundPlane{plane->down, plane->height_m, share, confidence};
}

struct Ground {
  GroundPlane plane;
  Sample sample;
};

std::optional<Ground> find(const Cloud& cloud, const Eigen::Vector3f& down,
                           const GroundPlaneParams& params) {
  Sample sample = thin(cloud, params);
  if (sample.size() < 50) return std::nullopt;
  auto plane = find_in(sample, down, params.ransac_iterations, params);
  if (!plane) plane = find_in(sample, down, params.hard_ransac_iterations, params);
  if (!plane) return std::nullopt;
  return Ground{*plane, std::move(sample)};
}

/// Median of the ground's points' distances along `down`: where a told gravity is off by half a
/// degree, this is right where the points are, not below the sensor.
float height_along(const Ground& ground, const Eigen::Vector3f& down, float inlier_m) {
  std::vector<float> heights_m;
  const GroundPlane& plane = ground.plane;
  for (std::size_t i = 0; i < ground.sample.size(); ++i) {
    const Eigen::Vector3f point = ground.sample.point(i);
    if (std::abs(plane.down.dot(point) - plane.height_m) <= inlier_m)
      heights_m.push_back(down.dot(point));
  }
  if (heights_m.empty()) return plane.height_m;
  const auto middle = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
  std::nth_element(heights_m.begin(), middle, heights_m.end());
  return *middle;
}

}  // namespace

std::optional<GroundPlane> find_ground_plane(const Cloud& cloud, const Eigen::Vector3f& down,
                                             const GroundPlaneParams& params) {
  const auto ground = find(cloud, down, params);
  if (!ground) return std::nullopt;
  return ground->plane;
}

std::optional<GroundPlane> complete_gravity(Cloud& cloud, const GroundPlaneParams& untold) {
  // A told direction is good to about half a degree, a level sensor's to nothing.
  constexpr double kToldTiltRad = 0.06;
  Gravity& gravity = cloud.stamp.gravity;
  const bool told = gravity.source != GravitySource::kLevel;
  if (told && gravity.sensor_height_m) return std::nullopt;
  GroundPlaneParams params = untold;
  if (told) {
    params = {};
    params.max_tilt_rad = kToldTiltRad;
  }
  const auto ground = find(cloud, gravity.down, params);
  if (!ground) return std::nullopt;
  if (!told) {
    gravity.down = ground->plane.down;
    gravity.source = GravitySource::kGroundPlane;
  }
  if (!gravity.sensor_height_m)
    gravity.sensor_height_m =
        height_along(*ground, gravity.down, static_cast<float>(params.inlier_distance_m));
  return ground->plane;
}

std::string describe(const Gravity& gravity, const std::optional<GroundPlane>& ground) {
  std::string text = "gravity ";
  switch (gravity.source) {
    case GravitySource::kRecording:
      text += "from the recording";
      break;
    case GravitySource::kOption:
      text += "from the option";
      break;
    case GravitySource::kGroundPlane:
      text += "from the ground plane";
      break;
    case GravitySource::kLevel:
      text += "not told: the sensor is taken to be level";
      break;
  }
  if (!ground) return text;
  return text +
         formatted("; ground %.2f m below the sensor, confidence %.2f, %.0f %% of the points",
                   static_cast<double>(ground->height_m), static_cast<double>(ground->confidence),
                   100.0 * static_cast<double>(ground->inlier_share));
}

}  // namespace limbcast
