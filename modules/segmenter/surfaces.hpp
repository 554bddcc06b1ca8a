#pragma once

#include <cstdint>
#include <vector>

#include "modules/segmenter/lattice.hpp"
#include "modules/segmenter/params.hpp"

namespace limbcast::segmenter {

/// A connected surface of a lattice, as large as the sensor sees it.
struct Surface {
  float area_m2 = 0.0F;   ///< facing the sensor
  float extent_m = 0.0F;  ///< the larger of the two level sides of its box
};

/// The connected surfaces of a lattice, the ground left out.
struct Surfaces {
  std::vector<std::int32_t> of_point;  ///< index into `all`; -1 at holes and on the ground
  std::vector<Surface> all;
};

Surfaces find_surfaces(const Lattice& lattice, const JointGrowingParams& params);

}  // namespace limbcast::segmenter
