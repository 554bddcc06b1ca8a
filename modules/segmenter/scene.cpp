#include "modules/segmenter/scene.hpp"

#include <algorithm>
#include <cmath>

#include "modules/segmenter/ground.hpp"
#include "modules/segmenter/panorama.hpp"

namespace limbcast::segmenter {
namespace {

/// Focal length of the thinned lattice [px]: a head at 4 m is then 12 pixels wide.
constexpr double kLatticeFocal_px = 260.0;

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

bool has_image(const Cloud& cloud) { return cloud.organized() && !cloud.colors.empty(); }

std::vector<std::int16_t> labels_of_cloud(const Scene& scene,
                                          const std::vector<std::int16_t>& labels,
                                          const JointGrowingParams& params) {
  return scene.cloud.organized() ? thicken(scene.cloud, scene.lattice, scene.step, labels, params)
                                 : labels_of_points(scene.cloud, scene.lattice, labels, params);
}

}  // namespace limbcast::segmenter
