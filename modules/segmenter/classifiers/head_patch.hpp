#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/segmenter/scene/lattice.hpp"

namespace limbcast::segmenter {

/// One grid of depths around a head that the classifier looks at.
struct PatchGrid {
  int columns = 0, rows = 0;
  float spacing_m = 0.0F;      ///< between two samples
  float top_m = 0.0F;          ///< first row over the head's centre
  float depth_scale_m = 0.0F;  ///< depth against the head's that counts one; more is no more
  /// Level distances instead of depths: the camera's pitch changes none.
  bool level = false;
};

/// From fine to coarse: the head's own relief; head, shoulders and hands beside it; the whole
/// person with the free space around.
inline constexpr std::array<PatchGrid, 3> kPatchGrids = {{{11, 13, 0.03F, 0.18F, 0.15F, true},
                                                          {13, 14, 0.075F, 0.375F, 0.3F, true},
                                                          {9, 13, 0.15F, 0.60F, 0.8F, true}}};

template <std::size_t kGrids>
constexpr int count_samples(const std::array<PatchGrid, kGrids>& grids) {
  int samples = 0;
  for (const PatchGrid& grid : grids) samples += grid.columns * grid.rows;
  return samples;
}

/// Two values a sample; the head's height, whether that is known, its distance and its noise.
inline constexpr int kPatchSize = 2 * count_samples(kPatchGrids) + 4;
/// Where the height stands, and after it whether it is known.
inline constexpr int kPatchHeight = 2 * count_samples(kPatchGrids);

/// Where and how a patch is taken; what differs from the default serves training.
struct PatchPlace {
  float u = 0.0F, v = 0.0F;  ///< lattice [px]
  float depth_m = 0.0F;      ///< of the head's surface
  float away_m = 0.0F;       ///< its level distance (Lattice::away_m)
  float height_m = 0.0F;     ///< over the ground, where known
  float scale = 1.0F;        ///< larger: wider spacing
  bool mirrored = false;
};

/// Where point `i` of the lattice is, at its own depth.
PatchPlace place_of_point(const Lattice& lattice, std::uint32_t i, bool mirrored);

/// Writes the depths, or level distances, of one grid around a place, as sample_patch tells, and
/// returns where they end.
float* write_grid(const Lattice& lattice, const PatchPlace& place, const PatchGrid& grid,
                  float* values);

/// Level distances around a candidate, grid by grid: (distance - head's) / scale within -1 to 1 or
/// 0 where nothing was measured, then 1 where measured, 0 in a hole, -1 outside the image.
std::vector<float> sample_patch(const Lattice& lattice, const PatchPlace& place);

}  // namespace limbcast::segmenter
