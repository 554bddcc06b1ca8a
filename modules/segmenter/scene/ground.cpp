#include "modules/segmenter/scene/ground.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "common/spread.hpp"

namespace limbcast::segmenter {
namespace {

constexpr float kBin_m = 0.02F;
/// Points looked at; enough for a plane, few enough for 0.1 ms.
constexpr std::size_t kSamples = 6000;
constexpr float kKnownHeightMargin_m = 0.15F;

std::vector<Eigen::Vector3f> sample(const Cloud& cloud) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(kSamples + 1);
  const std::size_t stride = std::max<std::size_t>(1, cloud.points_m.size() / kSamples);
  // A stride that shares a factor with the lattice's width would see some columns only; odd ones
  // spread.
  for (std::size_t i = 0; i < cloud.points_m.size(); i += stride | 1U) {
    const Eigen::Vector3f& point = cloud.points_m[i];
    if (!cloud.is_hole(i) && point.allFinite()) points.push_back(point);
  }
  return points;
}

/// Height of the sensor over the layer that holds many points and has few below it.
std::optional<float> lowest_layer(const std::vector<Eigen::Vector3f>& points,
                                  const Eigen::Vector3f& down, float min_m, float max_m,
                                  float min_count) {
  const int bins = static_cast<int>((max_m - min_m) / kBin_m) + 1;
  std::vector<float> histogram(static_cast<std::size_t>(bins), 0.0F);
  for (const Eigen::Vector3f& point : points) {
    const int bin = static_cast<int>(std::floor((down.dot(point) - min_m) / kBin_m));
    if (bin >= 0 && bin < bins) histogram[static_cast<std::size_t>(bin)] += 1.0F;
  }
  // Three bins, since gravity's error spreads the ground over some centimetres.
  float below = 0.0F, best_score = 0.0F;
  int best = -1;
  for (int i = bins - 2; i > 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    const float layer = histogram[k - 1] + histogram[k] + histogram[k + 1];
    const float score = layer - 2.0F * below;
    if (layer >= min_count && score > best_score) {
      best_score = score;
      best = i;
    }
    if (k + 3 < histogram.size()) below += histogram[k + 3];
  }
  if (best < 0) return std::nullopt;
  return min_m + (static_cast<float>(best) + 0.5F) * kBin_m;
}

/// Least squares of height = height_m - down . p with the points within `band_m` of the plane.
bool refit(const std::vector<Eigen::Vector3f>& points, float band_m, Ground& ground,
           std::size_t& inliers) {
  // down' = down + a * e1 + b * e2; residual = height' - down' . p
  const Eigen::Vector3f e1 = ground.down.unitOrthogonal();
  const Eigen::Vector3f e2 = ground.down.cross(e1);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  inliers = 0;
  for (const Eigen::Vector3f& point : points) {
    const float residual = ground.height_m - ground.down.dot(point);
    if (std::abs(residual) > band_m) continue;
    ++inliers;
    // Depth noise grows with the square of the distance.
    const double weight = 1.0 / (1.0 + std::pow(point.squaredNorm() / 9.0, 2));
    const Eigen::Vector3d row(-e1.dot(point), -e2.dot(point), 1.0);
    normal += weight * row * row.transpose();
    right -= weight * row * residual;
  }
  if (inliers < 20) return false;
  // A degree of tilt is worth as much as a few points, so that a sliver of ground cannot tip the
  // plane.
  normal(0, 0) += 10.0;
  normal(1, 1) += 10.0;
  const Eigen::Vector3f step = normal.ldlt().solve(right).cast<float>();
  if (!step.allFinite()) return false;
  const Eigen::Vector3f down = ground.down + step.x() * e1 + step.y() * e2;
  ground.height_m = (ground.height_m + step.z()) / down.norm();
  ground.down = down.normalized();
  return true;
}

/// How far (standard deviation) the points on the plane spread along it, in the narrower
/// direction [m].
double narrower_extent_m(const std::vector<Eigen::Vector3f>& points, const Ground& ground,
                         float band_m) {
  Spread spread;
  for (const Eigen::Vector3f& point : points) {
    if (std::abs(ground.height_m - ground.down.dot(point)) <= band_m)
      spread.add(point.cast<double>());
  }
  return spread.extent()[1];
}

}  // namespace

std::optional<Ground> find_ground(const Cloud& cloud, const GroundParams& params) {
  const std::vector<Eigen::Vector3f> points = sample(cloud);
  const float min_count = params.min_share * static_cast<float>(points.size());
  const Gravity& gravity = cloud.stamp.gravity;
  float min_m = params.min_sensor_height_m, max_m = params.max_sensor_height_m;
  if (gravity.sensor_height_m) {
    min_m = *gravity.sensor_height_m - kKnownHeightMargin_m;
    max_m = *gravity.sensor_height_m + kKnownHeightMargin_m;
  }
  const auto layer = lowest_layer(points, gravity.down, min_m, max_m, std::max(20.0F, min_count));
  if (!layer) return std::nullopt;

  Ground ground{gravity.down, *layer};
  std::size_t inliers = 0;
  for (const float band : {0.12F, 0.08F, params.inlier_distance_m, params.inlier_distance_m}) {
    if (!refit(points, band, ground, inliers)) return std::nullopt;
  }
  const bool is_tilted = ground.down.dot(gravity.down) < std::cos(params.max_tilt_rad);
  if (is_tilted)
    ground = {gravity.down, *layer};
  else if (static_cast<float>(inliers) < min_count)
    return std::nullopt;
  if (!gravity.sensor_height_m &&
      (ground.height_m < params.min_sensor_height_m ||
       narrower_extent_m(points, ground, params.inlier_distance_m) < params.min_extent_m))
    return std::nullopt;
  return ground;
}

}  // namespace limbcast::segmenter
