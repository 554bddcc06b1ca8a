#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/lattice.hpp"

namespace limbcast::segmenter {

/// A cloud on the grid that its people are searched in.
struct Scene {
  const Cloud& cloud;
  Lattice lattice;
  int step = 1;  ///< pixels of the cloud between two of the lattice's
};

/// A camera's cloud thinned, any other rendered into a panorama; over the ground, where it is in
/// sight. The scene keeps no copy of the cloud.
Scene look_at(const Cloud& cloud, const Params& params);

/// What the sensor saw along a ray.
struct SeenPoint {
  std::size_t point;  ///< index of the cloud's point
  float along;        ///< how many times the ray it is away
};

/// `ray` in the cloud's frame; nothing at a hole and outside.
std::optional<SeenPoint> look_along(const Scene& scene, const Eigen::Vector3f& ray);

/// Whether the cloud is a camera's coloured image.
bool has_image(const Cloud& cloud);

/// Labels of the whole cloud from those of the scene's lattice.
std::vector<std::int16_t> labels_of_cloud(const Scene& scene,
                                          const std::vector<std::int16_t>& labels,
                                          const JointGrowingParams& params);

}  // namespace limbcast::segmenter
