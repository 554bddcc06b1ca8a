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

/// What a cloud without a camera would look like from the sensor's place: a cylinder about gravity,
/// all 360 degrees, `depth_m` = level distance. Directions without a point take the nearest one's,
/// as far as neighbouring beams of a scanner stand apart.
Lattice render_panorama(const Cloud& cloud, const LevelFrame& frame, const PanoramaParams& params);

/// Index of the pixel that shows a place of the level frame; nothing of steep and too near ones.
std::optional<std::size_t> panorama_pixel(const Lattice& panorama, const Eigen::Vector3f& level_m);

/// Labels of the cloud's points from those of its panorama.
std::vector<std::int16_t> labels_of_points(const Cloud& cloud, const Lattice& panorama,
                                           const std::vector<std::int16_t>& labels,
                                           const JointGrowingParams& params);

}  // namespace limbcast::segmenter
