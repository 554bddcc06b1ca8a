#include "modules/segmenter/scene/panorama.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "common/units.hpp"
#include "modules/segmenter/scene/nearest_pixels.hpp"

namespace limbcast::segmenter {
namespace {

/// Steepest direction rendered (tangent of the elevation): 55 degrees. Steeper ones show no upright
/// person.
constexpr float kMaxSlope = 1.43F;
constexpr float kNearest_m = 0.3F;

struct Pixel {
  int u, v;
  float level_distance_m;
};

/// Where a point of the level frame is seen; v lies outside the image for steep or too near ones.
Pixel project(const Lattice& panorama, const Eigen::Vector3f& level_m) {
  const float distance_m = level_m.head<2>().norm();
  if (distance_m < kNearest_m) return {0, -1, distance_m};
  const float azimuth_rad = std::atan2(level_m.x(), level_m.y());
  const float slope = (level_m.z() - panorama.frame.sensor_height_m) / distance_m;
  const int u =
      static_cast<int>(std::floor(panorama.focal_px * (azimuth_rad + kPi<float>))) % panorama.width;
  return {u, static_cast<int>(std::floor((kMaxSlope - slope) * panorama.focal_px)), distance_m};
}

bool inside(const Lattice& panorama, const Pixel& pixel) {
  return pixel.v >= 0 && pixel.v < panorama.height;
}

void draw_points(const Cloud& cloud, Lattice& panorama) {
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    if (!cloud.points_m[i].allFinite()) continue;
    const Eigen::Vector3f level_m = panorama.frame.to_level(cloud.points_m[i]);
    const Pixel pixel = project(panorama, level_m);
    if (!inside(panorama, pixel)) continue;
    const std::size_t k = panorama.index(pixel.u, pixel.v);
    if (panorama.depth_m[k] > 0.0F && panorama.depth_m[k] <= pixel.level_distance_m) continue;
    panorama.depth_m[k] = pixel.level_distance_m;
    panorama.level_m[k] = level_m;
    panorama.source[k] = static_cast<std::uint32_t>(i);
  }
}

/// Label of the panorama's point that is nearest to a point of the cloud, at most `max_step_m`
/// away, at its pixel or beside it: a pixel shows the nearest of its points only, and where a limb
/// is seen end-on others lie far behind.
std::int16_t label_near(const Lattice& panorama, const std::vector<std::int16_t>& labels,
                        const Pixel& pixel, const Eigen::Vector3f& level_m, float max_step_m) {
  float nearest_m = max_step_m * max_step_m;
  std::int16_t label = kNobody;
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      const auto k = panorama.find(pixel.u + du, pixel.v + dv);
      if (!k) continue;
      const float distance_m = (panorama.level_m[*k] - level_m).squaredNorm();
      if (distance_m >= nearest_m) continue;
      nearest_m = distance_m;
      label = labels[*k];
    }
  }
  return label;
}

/// Gives empty directions the depth of the nearest one that has a point within `radius_px`.
void fill_gaps(int radius_px, Lattice& panorama) {
  const cv::Mat1b empty =
      cv::Mat1f(panorama.height, panorama.width, panorama.depth_m.data()) <= 0.0F;
  fill_from_nearest(empty, radius_px, [&](std::size_t pixel, std::size_t nearest) {
    const float depth_m = panorama.depth_m[nearest];
    const auto width = static_cast<std::size_t>(panorama.width);
    const std::size_t column = pixel % width, row = pixel / width;
    const float azimuth_rad = (static_cast<float>(column) + 0.5F) / panorama.focal_px - kPi<float>;
    const float slope = kMaxSlope - (static_cast<float>(row) + 0.5F) / panorama.focal_px;
    panorama.depth_m[pixel] = depth_m;
    panorama.level_m[pixel] = {depth_m * std::sin(azimuth_rad), depth_m * std::cos(azimuth_rad),
                               panorama.frame.sensor_height_m + slope * depth_m};
    panorama.source[pixel] = panorama.source[nearest];
  });
}

}  // namespace

Lattice render_panorama(const Cloud& cloud, const LevelFrame& frame, const PanoramaParams& params) {
  Lattice panorama;
  panorama.frame = frame;
  panorama.depth_noise = cloud.stamp.depth_noise;
  panorama.wraps_around = true;
  panorama.width = static_cast<int>(std::lround(2.0F * kPi<float> * params.focal_px));
  panorama.focal_px = static_cast<float>(panorama.width) / (2.0F * kPi<float>);
  panorama.height = static_cast<int>(2.0F * kMaxSlope * panorama.focal_px);
  const std::size_t size =
      static_cast<std::size_t>(panorama.width) * static_cast<std::size_t>(panorama.height);
  panorama.depth_m.assign(size, 0.0F);
  panorama.level_m.assign(size, Eigen::Vector3f::Zero());
  panorama.source.assign(size, 0);
  draw_points(cloud, panorama);
  fill_gaps(params.gap_px, panorama);
  return panorama;
}

std::optional<std::size_t> panorama_pixel(const Lattice& panorama, const Eigen::Vector3f& level_m) {
  const Pixel pixel = project(panorama, level_m);
  if (!inside(panorama, pixel)) return std::nullopt;
  return panorama.index(pixel.u, pixel.v);
}

std::vector<std::int16_t> labels_of_points(const Cloud& cloud, const Lattice& panorama,
                                           const std::vector<std::int16_t>& labels,
                                           const JointGrowingParams& params) {
  std::vector<std::int16_t> of_points(cloud.points_m.size(), kNobody);
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    if (!cloud.points_m[i].allFinite()) continue;
    const Eigen::Vector3f level_m = panorama.frame.to_level(cloud.points_m[i]);
    if (panorama.frame.ground_known && level_m.z() < params.ground_cut_m) continue;
    const Pixel pixel = project(panorama, level_m);
    if (!inside(panorama, pixel)) continue;
    of_points[i] =
        label_near(panorama, labels, pixel, level_m, params.longest_step_m(pixel.level_distance_m));
  }
  return of_points;
}

}  // namespace limbcast::segmenter
