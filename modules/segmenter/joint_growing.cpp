#include "modules/segmenter/joint_growing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace limbcast::segmenter {
namespace {

/// Width of a bucket of the priority queue [m]; ways within one are handled in the order they came.
constexpr float kBucket_m = 0.01F;
/// The eight neighbours, and two pixels away along the axes, to bridge a missing pixel.
constexpr std::array<std::array<int, 2>, 12> kNeighbors = {{{1, 0},
                                                            {-1, 0},
                                                            {0, 1},
                                                            {0, -1},
                                                            {1, 1},
                                                            {-1, 1},
                                                            {1, -1},
                                                            {-1, -1},
                                                            {2, 0},
                                                            {-2, 0},
                                                            {0, 2},
                                                            {0, -2}}};

/// Dijkstra's algorithm from many starts with a queue of buckets.
class Grower {
 public:
  Grower(const Lattice& lattice, const std::vector<HeadCandidate>& heads,
         const JointGrowingParams& params, const ReachParams& reach)
      : lattice_(lattice),
        heads_(heads),
        params_(params),
        reach_(reach),
        labels_(lattice.size(), kNobody),
        way_m_(lattice.size(), std::numeric_limits<float>::max()),
        buckets_(static_cast<std::size_t>(params.max_way_m / kBucket_m) + 2) {}

  std::vector<std::int16_t> run() {
    for (std::size_t k = 0; k < heads_.size(); ++k) start(static_cast<std::int16_t>(k));
    for (std::size_t b = 0; b < buckets_.size(); ++b) {
      // The bucket may grow while it is walked: short steps land in it again.
      for (std::size_t j = 0; j < buckets_[b].size(); ++j) {
        const std::uint32_t i = buckets_[b][j];
        if (bucket_of(way_m_[i]) == b) visit(i, b);
      }
    }
    return std::move(labels_);
  }

 private:
  static std::size_t bucket_of(float way_m) { return static_cast<std::size_t>(way_m / kBucket_m); }

  void start(std::int16_t k) {
    const HeadCandidate& head = heads_[static_cast<std::size_t>(k)];
    const float depth_m = lattice_.depth_m[lattice_.index(head.u, head.v)];
    const int radius_px =
        std::max(1, static_cast<int>(params_.head_radius_m * lattice_.focal_px / depth_m));
    for (int v = head.v - radius_px; v <= head.v + radius_px; ++v) {
      for (int u = head.u - radius_px; u <= head.u + radius_px; ++u) {
        const auto i = find(u, v);
        if (i == kOutside || way_m_[i] == 0.0F) continue;
        if ((lattice_.level_m[i] - head.center_m).squaredNorm() >
            params_.head_radius_m * params_.head_radius_m)
          continue;
        way_m_[i] = 0.0F;
        labels_[i] = k;
        buckets_[0].push_back(i);
      }
    }
  }

  /// Index of a point that is there, or kOutside.
  std::uint32_t find(int u, int v) const {
    if (lattice_.wraps_around) u = (u + lattice_.width) % lattice_.width;
    if (u < 0 || v < 0 || u >= lattice_.width || v >= lattice_.height) return kOutside;
    const std::size_t i = lattice_.index(u, v);
    return lattice_.depth_m[i] > 0.0F ? static_cast<std::uint32_t>(i) : kOutside;
  }

  void visit(std::uint32_t i, std::size_t bucket) {
    const int u = static_cast<int>(i) % lattice_.width, v = static_cast<int>(i) / lattice_.width;
    const Eigen::Vector3f& from = lattice_.level_m[i];
    const float z_m = lattice_.depth_m[i];
    const float max_step_m = std::max(params_.min_step_m, params_.step_per_m2 * z_m * z_m);
    for (const auto& [du, dv] : kNeighbors) {
      const std::uint32_t n = find(u + du, v + dv);
      if (n == kOutside) continue;
      const Eigen::Vector3f& to = lattice_.level_m[n];
      const Eigen::Vector3f step = to - from;
      const float squared = step.squaredNorm();
      if (squared > max_step_m * max_step_m) continue;
      const float way_m = way_m_[i] + std::max(1e-3F, std::sqrt(squared)) +
                          params_.depth_step_cost * std::abs(step.y());
      if (way_m >= way_m_[n] - 1e-4F || way_m > params_.max_way_m || !reachable(to, labels_[i]))
        continue;
      way_m_[n] = way_m;
      labels_[n] = labels_[i];
      buckets_[std::max(bucket, bucket_of(way_m))].push_back(n);
    }
  }

  bool reachable(const Eigen::Vector3f& point, std::int16_t label) const {
    const Eigen::Vector3f& head = heads_[static_cast<std::size_t>(label)].center_m;
    if (point.z() > head.z() + reach_.above_m || point.z() < head.z() - reach_.below_m)
      return false;
    float radius_m = reach_.radius_m;
    if (lattice_.frame.ground_known) {
      if (point.z() < params_.ground_cut_m) return false;
      if (point.z() < params_.shin_height * head.z())
        radius_m = params_.shin_radius_m;
      else if (point.z() < params_.knee_height * head.z())
        radius_m = params_.knee_radius_m;
    }
    return (point - head).head<2>().squaredNorm() <= radius_m * radius_m;
  }

  static constexpr std::uint32_t kOutside = std::numeric_limits<std::uint32_t>::max();
  const Lattice& lattice_;
  const std::vector<HeadCandidate>& heads_;
  const JointGrowingParams& params_;
  const ReachParams& reach_;
  std::vector<std::int16_t> labels_;
  std::vector<float> way_m_;
  std::vector<std::vector<std::uint32_t>> buckets_;
};

}  // namespace

std::vector<std::int16_t> grow_together(const Lattice& lattice,
                                        const std::vector<HeadCandidate>& heads,
                                        const JointGrowingParams& params,
                                        const ReachParams& reach) {
  return Grower(lattice, heads, params, reach).run();
}

}  // namespace limbcast::segmenter
