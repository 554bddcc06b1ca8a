#include "modules/segmenter/scene/lattice.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace limbcast::segmenter {

LevelFrame make_level_frame(const Gravity& gravity, const std::optional<Ground>& ground) {
  const Eigen::Vector3f down = ground ? ground->down : gravity.down;
  // "Away" is the optical axis without its vertical part; looking straight down, the image's up.
  Eigen::Vector3f away = Eigen::Vector3f::UnitZ() - down * down.z();
  if (away.norm() < 0.1F) away = -Eigen::Vector3f::UnitY() + down * down.y();
  away.normalize();
  LevelFrame frame;
  frame.level_from_sensor.row(0) = down.cross(away);
  frame.level_from_sensor.row(1) = away;
  frame.level_from_sensor.row(2) = -down;
  frame.ground_known = ground.has_value();
  if (ground) frame.sensor_height_m = ground->height_m;
  return frame;
}

Lattice thin(const Cloud& cloud, const LevelFrame& frame, int step) {
  Lattice lattice;
  lattice.frame = frame;
  lattice.depth_noise = cloud.stamp.depth_noise;
  lattice.width = (cloud.width + step - 1) / step;
  lattice.height = (cloud.height + step - 1) / step;
  lattice.focal_px = static_cast<float>(cloud.camera->fx) / static_cast<float>(step);
  const Eigen::Vector2f image_up = frame.level_from_sensor.row(2).head<2>().transpose();
  if (image_up.norm() > 0.2F) lattice.up = image_up.normalized();

  const std::size_t size =
      static_cast<std::size_t>(lattice.width) * static_cast<std::size_t>(lattice.height);
  lattice.depth_m.resize(size);
  lattice.level_m.resize(size);
  lattice.source.resize(size);
  std::size_t i = 0;
  for (int v = 0; v < cloud.height; v += step) {
    for (int u = 0; u < cloud.width; u += step, ++i) {
      const auto source = static_cast<std::size_t>(v) * static_cast<std::size_t>(cloud.width) +
                          static_cast<std::size_t>(u);
      const Eigen::Vector3f& point = cloud.points_m[source];
      lattice.source[i] = static_cast<std::uint32_t>(source);
      const bool hole = !(point.z() > 0.0F) || !std::isfinite(point.z());
      lattice.depth_m[i] = hole ? 0.0F : point.z();
      lattice.level_m[i] = hole ? Eigen::Vector3f(0.0F, 0.0F, 0.0F) : frame.to_level(point);
    }
  }
  return lattice;
}

std::vector<std::int16_t> thicken(const Cloud& cloud, const Lattice& lattice, int step,
                                  const std::vector<std::int16_t>& labels,
                                  const JointGrowingParams& params) {
  std::vector<std::int16_t> dense(cloud.points_m.size(), kNobody);
  const Eigen::Vector3f up = lattice.frame.level_from_sensor.row(2);
  std::size_t i = 0;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u, ++i) {
      const int left = u / step, top = v / step;
      const int right = std::min(left + (u % step > 0 ? 1 : 0), lattice.width - 1);
      const int bottom = std::min(top + (v % step > 0 ? 1 : 0), lattice.height - 1);
      const std::array<std::size_t, 4> around = {
          lattice.index(left, top), lattice.index(right, top), lattice.index(left, bottom),
          lattice.index(right, bottom)};
      if (std::none_of(around.begin(), around.end(),
                       [&](std::size_t k) { return labels[k] != kNobody; }))
        continue;
      const Eigen::Vector3f& point = cloud.points_m[i];
      if (!(point.z() > 0.0F) || !std::isfinite(point.z())) continue;
      if (lattice.frame.ground_known &&
          up.dot(point) + lattice.frame.sensor_height_m < params.ground_cut_m)
        continue;
      float nearest_m = params.longest_step_m(point.z());
      for (const std::size_t k : around) {
        if (lattice.depth_m[k] <= 0.0F) continue;
        const float distance_m = std::abs(lattice.depth_m[k] - point.z());
        if (distance_m >= nearest_m) continue;
        nearest_m = distance_m;
        dense[i] = labels[k];
      }
    }
  }
  return dense;
}

}  // namespace limbcast::segmenter
