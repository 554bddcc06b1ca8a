#pragma once

#include <cstdint>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "modules/segmenter/lattice.hpp"
#include "modules/segmenter/params.hpp"

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

/// Whether the cloud is a camera's coloured image.
bool has_image(const Cloud& cloud);

/// Labels of the whole cloud from those of the scene's lattice.
std::vector<std::int16_t> labels_of_cloud(const Scene& scene,
                                          const std::vector<std::int16_t>& labels,
                                          const JointGrowingParams& params);

}  // namespace limbcast::segmenter
