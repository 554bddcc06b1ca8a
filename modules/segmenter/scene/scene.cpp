#include "modules/segmenter/scene/scene.hpp"

#include <algorithm>
#include <cmath>

#include "modules/segmenter/scene/ground.hpp"
#include "modules/segmenter/scene/panorama.hpp"

namespace limbcast::segmenter {
namespace {

/// Focal length of the thinned lattice [px]: a head at 4 m is then 12 pixels wide.
constexpr double kLatticeFocal_px = 260.0;

/// Of a camera's cloud.
std::optional<SeenPoint> look_into_image(const Cloud& cloud, const Eigen::Vector3f& ray) {
  constexpr float kLeastZ = 0.05F;  // beside the camera there is no pixel
  if (!(ray.z() > kLeastZ)) return std::nullopt;
  const Eigen::Vector2f px = cloud.camera->project(ray).array().round();
  if (!(px.minCoeff() >= 0.0F) || !(px.x() < static_cast<float>(cloud.width)) ||
      !(px.y() < static_cast<float>(cloud.height)))
    return std::nullopt;
  const std::size_t point =
      static_cast<std::size_t>(px.y()) * static_cast<std::size_t>(cloud.width) +
      static_cast<std::size_t>(px.x());
  const float depth_m = cloud.points_m[point].z();
  if (!(depth_m > 0.0F) || !std::isfinite(depth_m)) return std::nullopt;
  return SeenPoint{point, depth_m / ray.z()};
}

std::optional<SeenPoint> look_into_panorama(const Lattice& panorama, const Eigen::Vector3f& ray) {
  const auto pixel = panorama_pixel(panorama, panorama.frame.to_level(ray));
  if (!pixel || !(panorama.depth_m[*pixel] > 0.0F)) return std::nullopt;
  const Eigen::Vector3f level_ray = panorama.frame.level_from_sensor * ray;
  return SeenPoint{panorama.source[*pixel], panorama.depth_m[*pixel] / level_ray.head<2>().norm()};
}

}  // namespace

Scene look_at(const Cloud& cloud, const Params& params) {
  const LevelFrame frame = make_level_frame(cloud.stamp.gravity, find_ground(cloud, params.ground));
  Scene scene{cloud, {}};
  if (!cloud.organized()) {
    scene.lattice = render_panorama(cloud, frame, params.panorama);
    return scene;
  }
  scene.step = std::max(1, static_cast<int>(std::lround(cloud.camera->fx / kLatticeFocal_px)));
  scene.lattice = thin(cloud, frame, scene.step);
  return scene;
}

std::optional<SeenPoint> look_along(const Scene& scene, const Eigen::Vector3f& ray) {
  return scene.cloud.organized() ? look_into_image(scene.cloud, ray)
                                 : look_into_panorama(scene.lattice, ray);
}

bool has_image(const Cloud& cloud) { return cloud.organized() && !cloud.colors.empty(); }

std::vector<std::int16_t> labels_of_cloud(const Scene& scene,
                                          const std::vector<std::int16_t>& labels,
                                          const JointGrowingParams& params) {
  return scene.cloud.organized() ? thicken(scene.cloud, scene.lattice, scene.step, labels, params)
                                 : labels_of_points(scene.cloud, scene.lattice, labels, params);
}

}  // namespace limbcast::segmenter
