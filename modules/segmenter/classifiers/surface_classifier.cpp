#include "modules/segmenter/classifiers/surface_classifier.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace limbcast::segmenter {
namespace {

#include "modules/segmenter/classifiers/surface_network.inc"

/// Points that the network is asked of; more tell nothing new of one surface.
constexpr std::size_t kAsked = 300;
/// A height that counts zero, the depth and the noise that count one [m].
constexpr float kMeanSurfaceHeight_m = 0.9F, kMeanSurfaceDepth_m = 2.7F,
                kSurfaceNoiseScale_m = 0.1F;
/// Odds of one point count no more than this: one sure point makes no body.
constexpr float kMostOdds = 4.0F;

}  // namespace

SurfaceClassifier::SurfaceClassifier() : SurfaceClassifier(unpack(kSurfaceNetwork)) {
  if (kSurfaceNetwork.inputs != kSurfaceInputSize)
    throw std::logic_error("surface_network.inc: trained for other inputs; run train.sh");
}

SurfaceClassifier::SurfaceClassifier(Network network) : network_(std::move(network)) {}

SurfaceInput surface_input(const Lattice& lattice, std::uint32_t i, bool mirrored) {
  const PatchPlace place = place_of_point(lattice, i, mirrored);
  SurfaceInput input;
  float* values = input.data();
  for (const PatchGrid& grid : kSurfaceGrids) values = write_grid(lattice, place, grid, values);
  const float known = lattice.frame.ground_known ? 1.0F : 0.0F;
  input.tail<kSurfacePlaceSize>() << known, known * (lattice.level_m[i].z() - kMeanSurfaceHeight_m),
      std::log(place.depth_m / kMeanSurfaceDepth_m),
      lattice.depth_noise.sigma_m(place.depth_m) / kSurfaceNoiseScale_m;
  return input;
}

float SurfaceClassifier::mean_odds(const Lattice& lattice,
                                   const std::vector<std::uint32_t>& points) const {
  const std::size_t step = std::max<std::size_t>(1, points.size() / kAsked);
  const std::size_t count = (points.size() + step - 1) / step;
  Network::Weights inputs(static_cast<Eigen::Index>(count), kSurfaceInputSize);
  for (std::size_t k = 0; k < count; ++k)
    inputs.row(static_cast<Eigen::Index>(k)) = surface_input(lattice, points[k * step], false);
  return network_.log_odds(inputs).cwiseMax(-kMostOdds).cwiseMin(kMostOdds).mean();
}

}  // namespace limbcast::segmenter
