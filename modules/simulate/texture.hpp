#pragma once

#include <Eigen/Core>

#include "modules/simulate/surface.hpp"

namespace limbcast::simulate {

/// Colour (blue, green, red; 0 to 255) of a material at `point` of its solid texture. Details finer
/// than `footprint_m`, the size of a pixel there, are left out, as a lens would blur them.
Eigen::Vector3f texture_color(const Material& material, const Eigen::Vector3f& point,
                              float footprint_m);

}  // namespace limbcast::simulate
