#pragma once

#include <cstdint>
#include <vector>

#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/lattice.hpp"

namespace limbcast::segmenter {

/// A connected surface of a lattice, as large as the sensor sees it.
struct Surface {
  float area_m2 = 0.0F;   ///< facing the sensor
  float extent_m = 0.0F;  ///< the larger of the two level sides of its box
};

/// The connected surfaces of a lattice, the ground left out.
struct Surfaces {
  std::vector<std::int32_t> of_point;  ///< index into `all`; -1 where there is none
  std::vector<Surface> all;
};

/// Points that `taken` gives a label are on none.
Surfaces find_surfaces(const Lattice& lattice, const SurfaceParams& params,
                       const std::vector<std::int16_t>* taken = nullptr);

/// The points of each surface, in the order of `surfaces.all`.
std::vector<std::vector<std::uint32_t>> points_by_surface(const Surfaces& surfaces);

}  // namespace limbcast::segmenter
