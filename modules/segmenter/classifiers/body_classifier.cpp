#include "modules/segmenter/classifiers/body_classifier.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "modules/segmenter/scene/lattice_box.hpp"

namespace limbcast::segmenter {
namespace {

#include "modules/segmenter/classifiers/body_network.inc"

/// In both directions the network is asked for every second point, to spare time.
constexpr int kStride_px = 2;
/// Odds are averaged over this half width [lattice px], and over points no farther than this [m].
constexpr int kMeanReach_px = 3;
constexpr float kMeanReach_m = 0.08F;

/// Offsets against the head that count one [m]: a trunk's size.
constexpr float kOffsetScale_m = 0.5F;
/// A head's height that counts zero, the depth and the noise that count one, as in head patches
/// [m].
constexpr float kMeanHeight_m = 1.35F, kMeanDepth_m = 2.7F, kNoiseScale_m = 0.1F;

std::vector<std::uint32_t> asked_points(const Lattice& lattice,
                                        const std::vector<std::uint32_t>& points) {
  std::vector<std::uint32_t> asked;
  for (const std::uint32_t i : points) {
    const int u = static_cast<int>(i) % lattice.width, v = static_cast<int>(i) / lattice.width;
    if (u % kStride_px == 0 && v % kStride_px == 0) asked.push_back(i);
  }
  return asked;
}

/// The first asked row from there on.
int asked_from(int row) { return (row + kStride_px - 1) / kStride_px * kStride_px; }

/// Log odds at the points of a cluster.
class OddsInBox {
 public:
  OddsInBox(const Lattice& lattice, const std::vector<std::uint32_t>& points)
      : width_(lattice.width),
        box_(box_around(lattice, points)),
        odds_(static_cast<std::size_t>(box_.area()), 0.0F) {}

  float& at(std::uint32_t i) { return odds_[place(i)]; }
  float at(std::uint32_t i) const { return odds_[place(i)]; }

 private:
  std::size_t place(std::uint32_t i) const {
    const int u = static_cast<int>(i) % width_ - box_.x, v = static_cast<int>(i) / width_ - box_.y;
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(box_.width) +
           static_cast<std::size_t>(u);
  }

  int width_;
  cv::Rect box_;
  std::vector<float> odds_;
};

/// Mean over the asked points of the cluster that lie near; 0 where there is none.
float mean_near(const Lattice& lattice, const std::vector<std::int16_t>& labels,
                const OddsInBox& asked_odds, std::uint32_t i) {
  const int u = static_cast<int>(i) % lattice.width, v = static_cast<int>(i) / lattice.width;
  float sum = 0.0F;
  int count = 0;
  const int last_row = std::min(lattice.height - 1, v + kMeanReach_px);
  for (int y = asked_from(std::max(0, v - kMeanReach_px)); y <= last_row; y += kStride_px) {
    for (int du = -kMeanReach_px; du <= kMeanReach_px; ++du) {
      const auto n = lattice.find(u + du, y);  // beyond a panorama's seam too
      if (!n || static_cast<int>(*n) % lattice.width % kStride_px != 0) continue;
      const bool near =
          (lattice.level_m[*n] - lattice.level_m[i]).squaredNorm() <= kMeanReach_m * kMeanReach_m;
      if (labels[*n] != labels[i] || !near) continue;
      sum += asked_odds.at(*n);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : 0.0F;
}

}  // namespace

BodyClassifier::BodyClassifier() : BodyClassifier(unpack(kBodyNetwork)) {
  if (kBodyNetwork.inputs != kPointInputSize)
    throw std::logic_error("body_network.inc: trained for other inputs; run train.sh");
}

BodyClassifier::BodyClassifier(Network network) : network_(std::move(network)) {}

PointInput point_input(const Lattice& lattice, const HeadCandidate& head, std::uint32_t i,
                       bool mirrored) {
  const PatchPlace place = place_of_point(lattice, i, mirrored);
  PointInput input;
  float* values = input.data();
  for (const PatchGrid& grid : kPointGrids) values = write_grid(lattice, place, grid, values);
  Eigen::Vector3f offset = from_head(lattice, head, lattice.level_m[i]) / kOffsetScale_m;
  if (mirrored) offset.x() = -offset.x();
  const float known = lattice.frame.ground_known ? 1.0F : 0.0F;
  input.tail<kPointPlaceSize>() << offset.x(), std::abs(offset.x()), offset.y(), offset.z(),
      offset.norm(), known, known * lattice.level_m[i].z(),
      known * (head.center_m.z() - kMeanHeight_m) / kOffsetScale_m,
      std::log(place.depth_m / kMeanDepth_m),
      lattice.depth_noise.sigma_m(place.depth_m) / kNoiseScale_m;
  return input;
}

std::vector<float> BodyClassifier::body_odds(const Lattice& lattice, const HeadCandidate& head,
                                             const std::vector<std::int16_t>& labels,
                                             const std::vector<std::uint32_t>& points) const {
  std::vector<float> odds(points.size(), 0.0F);
  const std::vector<std::uint32_t> asked = asked_points(lattice, points);
  if (asked.empty()) return odds;
  Network::Weights inputs(static_cast<Eigen::Index>(asked.size()), network_.hidden_weights.cols());
  for (std::size_t k = 0; k < asked.size(); ++k)
    inputs.row(static_cast<Eigen::Index>(k)) = point_input(lattice, head, asked[k], false);
  const Eigen::VectorXf told = network_.log_odds(inputs);
  OddsInBox asked_odds(lattice, asked);
  for (std::size_t k = 0; k < asked.size(); ++k)
    asked_odds.at(asked[k]) = told[static_cast<Eigen::Index>(k)];
  for (std::size_t k = 0; k < points.size(); ++k)
    odds[k] = mean_near(lattice, labels, asked_odds, points[k]);
  return odds;
}

}  // namespace limbcast::segmenter
