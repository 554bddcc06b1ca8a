#pragma once

#include <vector>

#include "modules/segmenter/lattice.hpp"

namespace limbcast::segmenter {

/// Columns and rows of the depths around a head that the classifier looks at; 6 cm apart, from 0.36
/// m over the head's centre to 0.66 m under it.
inline constexpr int kPatchColumns = 15, kPatchRows = 18;
/// Two planes (depth against the head's, and whether it was measured) and the head's height.
inline constexpr int kPatchSize = 2 * kPatchColumns * kPatchRows + 2;

/// Where and how a patch is taken; what differs from the default serves training.
struct PatchPlace {
  float u = 0.0F, v = 0.0F;  ///< lattice [px]
  float depth_m = 0.0F;      ///< of the head's surface
  float height_m = 0.0F;     ///< over the ground, where known
  float scale = 1.0F;        ///< larger: wider spacing
  bool mirrored = false;
};

/// Depths around a candidate: (depth - head's) / 0.3 m within -1 to 1, then 1 where measured, else
/// 0; then the height over the ground and whether it is known.
std::vector<float> sample_patch(const Lattice& lattice, const PatchPlace& place);

}  // namespace limbcast::segmenter
