#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/segmenter/classifiers/head_patch.hpp"
#include "modules/segmenter/networks/network.hpp"
#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"

namespace limbcast::segmenter {

/// The grids of depths around a point of a cluster: its own surface, and what is around it.
inline constexpr std::array<PatchGrid, 2> kPointGrids = {
    {{5, 5, 0.06F, 0.12F, 0.15F}, {7, 7, 0.18F, 0.54F, 0.5F}}};

/// Numbers that tell of the point itself: its place against the head, over the ground and in depth.
inline constexpr int kPointPlaceSize = 10;
inline constexpr int kPointInputSize = 2 * count_samples(kPointGrids) + kPointPlaceSize;
using PointInput = Eigen::Matrix<float, kPointInputSize, 1>;

/// Tells the points of a body from those of what it touches, by the surface around a point and by
/// the point's place against the head: depth differences as features of body parts are from J.
/// Shotton et al., "Real-time human pose recognition in parts from single depth images", CVPR 2011.
/// Trained by limbcast-train-bodies on the clouds of cameras; serves those of laser range finders
/// too.
class BodyClassifier {
 public:
  /// The network that ships with the library.
  BodyClassifier();
  explicit BodyClassifier(Network network);

  /// Log odds that a point is a body's, averaged over its neighbours on the surface, for each of
  /// `points`: those that carry the head's label.
  std::vector<float> body_odds(const Lattice& lattice, const HeadCandidate& head,
                               const std::vector<std::int16_t>& labels,
                               const std::vector<std::uint32_t>& points) const;

 private:
  Network network_;
};

/// A point of the cluster of this head, as the network reads it.
PointInput point_input(const Lattice& lattice, const HeadCandidate& head, std::uint32_t i,
                       bool mirrored);

}  // namespace limbcast::segmenter
