#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/segmenter/classifiers/head_patch.hpp"
#include "modules/segmenter/networks/network.hpp"
#include "modules/segmenter/scene/lattice.hpp"

namespace limbcast::segmenter {

/// The grids of depths around a point of a surface: its own relief, the limb that it is on, and
/// what is around that.
inline constexpr std::array<PatchGrid, 3> kSurfaceGrids = {
    {{5, 5, 0.06F, 0.12F, 0.15F}, {7, 7, 0.18F, 0.54F, 0.5F}, {7, 9, 0.35F, 1.4F, 1.0F}}};
/// Numbers that tell of the point itself: its height over the ground, its depth and noise.
inline constexpr int kSurfacePlaceSize = 4;
inline constexpr int kSurfaceInputSize = 2 * count_samples(kSurfaceGrids) + kSurfacePlaceSize;
using SurfaceInput = Eigen::Matrix<float, kSurfaceInputSize, 1>;

/// Tells a surface of a body from one of furniture where no head is in sight, by the depths around
/// its points. Trained by limbcast-train-surfaces on the clouds of cameras.
class SurfaceClassifier {
 public:
  /// The network that ships with the library.
  SurfaceClassifier();
  explicit SurfaceClassifier(Network network);

  /// Mean log odds that these points of the lattice are a body's.
  float mean_odds(const Lattice& lattice, const std::vector<std::uint32_t>& points) const;

 private:
  Network network_;
};

/// A point of a surface, as the network reads it.
SurfaceInput surface_input(const Lattice& lattice, std::uint32_t i, bool mirrored);

}  // namespace limbcast::segmenter
