#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/ground.hpp"

namespace limbcast::segmenter {

/// A frame that stands upright: x to the right, y away from the sensor, both level; z up. Origin:
/// on the ground under the sensor, or at the sensor's own height where the ground is not known.
struct LevelFrame {
  Eigen::Matrix3f level_from_sensor = Eigen::Matrix3f::Identity();
  float sensor_height_m = 0.0F;
  bool ground_known = false;

  Eigen::Vector3f to_level(const Eigen::Vector3f& sensor_m) const {
    return level_from_sensor * sensor_m + Eigen::Vector3f(0.0F, 0.0F, sensor_height_m);
  }
  Eigen::Vector3f to_sensor(const Eigen::Vector3f& level_m) const {
    return level_from_sensor.transpose() * (level_m - Eigen::Vector3f(0.0F, 0.0F, sensor_height_m));
  }
  /// Gravity's direction, in the sensor's frame.
  Eigen::Vector3f down() const { return -level_from_sensor.row(2).transpose(); }
};

LevelFrame make_level_frame(const Gravity& gravity, const std::optional<Ground>& ground);

/// Points on a grid of rays, in a level frame: a camera's cloud, thinned to spare time, or an
/// unorganised one rendered into a panorama. Distances across are seen as focal_px / depth pixels a
/// metre.
struct Lattice {
  int width = 0, height = 0;
  float focal_px = 0.0F;
  /// Direction of "up" in the image: (0, -1) for a camera without roll.
  Eigen::Vector2f up{0.0F, -1.0F};
  bool wraps_around = false;   ///< column 0 is the neighbour of the last (panorama of 360 degrees)
  std::vector<float> depth_m;  ///< distance along the optical axis (panorama: level), 0 = hole
  std::vector<Eigen::Vector3f> level_m;  ///< LevelFrame; (0, 0, 0) at holes
  std::vector<std::uint32_t> source;     ///< index of the cloud's point, meaningless at holes
  LevelFrame frame;
  DepthNoise depth_noise;

  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(u);
  }
  std::size_t size() const { return depth_m.size(); }
  /// Level distance of a measured point, of a camera along its level optical axis: as depth_m, but
  /// however the camera is pitched, what stands upright is as far away at its foot as at its head.
  float away_m(std::size_t i) const { return wraps_around ? depth_m[i] : level_m[i].y(); }
  /// Index of the point there; nothing at a hole and outside.
  std::optional<std::uint32_t> find(int u, int v) const {
    if (wraps_around) u = (u + width) % width;
    if (u < 0 || v < 0 || u >= width || v >= height) return std::nullopt;
    const std::size_t i = index(u, v);
    if (depth_m[i] <= 0.0F) return std::nullopt;
    return static_cast<std::uint32_t>(i);
  }
};

/// Label of a point that belongs to no cluster.
inline constexpr std::int16_t kNobody = -1;
/// Label of a point of which is not known whether it is a person's: the range images leave it out
/// as if it had not been measured.
inline constexpr std::int16_t kUnsure = -2;

/// The points that carry each of the labels 0 ... num_labels - 1, row by row.
template <class Label>
std::vector<std::vector<std::uint32_t>> points_by_label(const std::vector<Label>& labels,
                                                        std::size_t num_labels) {
  std::vector<std::vector<std::uint32_t>> points(num_labels);
  for (std::uint32_t i = 0; i < labels.size(); ++i) {
    if (labels[i] >= 0) points[static_cast<std::size_t>(labels[i])].push_back(i);
  }
  return points;
}

/// Every `step`-th pixel of an organised cloud in both directions.
Lattice thin(const Cloud& cloud, const LevelFrame& frame, int step);

/// Labels of the whole cloud from those of its thinned lattice: each pixel takes that of the
/// nearest of the (up to four) lattice points around it, if a step of growing reaches it and it is
/// not ground.
std::vector<std::int16_t> thicken(const Cloud& cloud, const Lattice& lattice, int step,
                                  const std::vector<std::int16_t>& labels,
                                  const JointGrowingParams& params);

}  // namespace limbcast::segmenter
