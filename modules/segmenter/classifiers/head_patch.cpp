#include "modules/segmenter/classifiers/head_patch.hpp"

#include <algorithm>
#include <cmath>

namespace limbcast::segmenter {
namespace {

/// Height that counts zero, and the scale [m]: heads of standing and seated people lie within one
/// scale.
constexpr float kMeanHeadHeight_m = 1.35F, kHeightScale_m = 0.5F;
/// Depth that counts zero [m]: people stand 1.5 to 5 m off.
constexpr float kMeanHeadDepth_m = 2.7F;
/// Noise of a depth that counts one [m].
constexpr float kHeadNoiseScale_m = 0.1F;

}  // namespace

PatchPlace place_of_point(const Lattice& lattice, std::uint32_t i, bool mirrored) {
  const int u = static_cast<int>(i) % lattice.width, v = static_cast<int>(i) / lattice.width;
  PatchPlace place;
  place.u = static_cast<float>(u);
  place.v = static_cast<float>(v);
  place.depth_m = lattice.depth_m[i];
  place.away_m = lattice.away_m(i);
  place.mirrored = mirrored;
  return place;
}

float* write_grid(const Lattice& lattice, const PatchPlace& place, const PatchGrid& grid,
                  float* values) {
  const Eigen::Vector2f right(-lattice.up.y(), lattice.up.x());
  const Eigen::Vector2f middle(place.u + 0.5F, place.v + 0.5F);
  const float px_per_m = lattice.focal_px / place.depth_m * place.scale;
  const float side = place.mirrored ? -1.0F : 1.0F;
  const int middle_column = grid.columns / 2;
  for (int row = 0; row < grid.rows; ++row) {
    const float up_m = grid.top_m - static_cast<float>(row) * grid.spacing_m;
    for (int column = 0; column < grid.columns; ++column) {
      const float across_m = side * static_cast<float>(column - middle_column) * grid.spacing_m;
      const Eigen::Vector2f at = middle + px_per_m * (across_m * right + up_m * lattice.up);
      int u = static_cast<int>(std::floor(at.x()));
      const int v = static_cast<int>(std::floor(at.y()));
      if (lattice.wraps_around) u = (u % lattice.width + lattice.width) % lattice.width;
      const bool inside = u >= 0 && v >= 0 && u < lattice.width && v < lattice.height;
      const std::size_t i = inside ? lattice.index(u, v) : 0;
      const bool measured = inside && lattice.depth_m[i] > 0.0F;
      const float farther_m =
          grid.level ? lattice.away_m(i) - place.away_m : lattice.depth_m[i] - place.depth_m;
      const float relative = farther_m / grid.depth_scale_m;
      *values++ = measured ? std::clamp(relative, -1.0F, 1.0F) : 0.0F;
      *values++ = measured ? 1.0F : inside ? 0.0F : -1.0F;
    }
  }
  return values;
}

std::vector<float> sample_patch(const Lattice& lattice, const PatchPlace& place) {
  std::vector<float> patch(kPatchSize);
  float* values = patch.data();
  for (const PatchGrid& grid : kPatchGrids) values = write_grid(lattice, place, grid, values);
  const bool known = lattice.frame.ground_known;
  *values++ = known ? (place.height_m - kMeanHeadHeight_m) / kHeightScale_m : 0.0F;
  *values++ = known ? 1.0F : 0.0F;
  *values++ = std::log(place.depth_m / kMeanHeadDepth_m);
  *values++ = lattice.depth_noise.sigma_m(place.depth_m) / kHeadNoiseScale_m;
  return patch;
}

}  // namespace limbcast::segmenter
