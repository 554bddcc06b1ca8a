#include "modules/segmenter/head_patch.hpp"

#include <algorithm>
#include <cmath>

namespace limbcast::segmenter {
namespace {

constexpr float kSpacing_m = 0.06F, kTop_m = 0.36F;
constexpr float kDepthScale_m = 0.3F;
/// Height that counts zero, and the scale [m]: heads of standing and seated people lie within one
/// scale.
constexpr float kMeanHeight_m = 1.35F, kHeightScale_m = 0.5F;

}  // namespace

std::vector<float> sample_patch(const Lattice& lattice, const PatchPlace& place) {
  std::vector<float> patch;
  patch.reserve(kPatchSize);
  const Eigen::Vector2f right(-lattice.up.y(), lattice.up.x());
  const float px_per_m = lattice.focal_px / place.depth_m * place.scale;
  for (int row = 0; row < kPatchRows; ++row) {
    for (int column = 0; column < kPatchColumns; ++column) {
      const float side = place.mirrored ? -1.0F : 1.0F;
      const float across_m = side * static_cast<float>(column - kPatchColumns / 2) * kSpacing_m;
      const float up_m = kTop_m - static_cast<float>(row) * kSpacing_m;
      const Eigen::Vector2f at = Eigen::Vector2f(place.u + 0.5F, place.v + 0.5F) +
                                 px_per_m * (across_m * right + up_m * lattice.up);
      int u = static_cast<int>(std::floor(at.x()));
      const int v = static_cast<int>(std::floor(at.y()));
      if (lattice.wraps_around) u = (u % lattice.width + lattice.width) % lattice.width;
      const bool inside = u >= 0 && v >= 0 && u < lattice.width && v < lattice.height;
      const float depth_m = inside ? lattice.depth_m[lattice.index(u, v)] : 0.0F;
      patch.push_back(depth_m > 0.0F
                          ? std::clamp((depth_m - place.depth_m) / kDepthScale_m, -1.0F, 1.0F)
                          : 0.0F);
      patch.push_back(depth_m > 0.0F ? 1.0F : 0.0F);
    }
  }
  const bool known = lattice.frame.ground_known;
  patch.push_back(known ? (place.height_m - kMeanHeight_m) / kHeightScale_m : 0.0F);
  patch.push_back(known ? 1.0F : 0.0F);
  return patch;
}

}  // namespace limbcast::segmenter
