#include "modules/segmenter/growing/paper_growing.hpp"

namespace limbcast::segmenter {

bool ReachCylinder::contains(const Eigen::Vector3f& point_m) const {
  const Eigen::Vector3f from_seed = point_m - seed_m_;
  const float down_m = down_.dot(from_seed);
  if (down_m > params_.below_m || down_m < -params_.above_m) return false;
  return from_seed.squaredNorm() - down_m * down_m <= params_.radius_m * params_.radius_m;
}

std::vector<std::uint32_t> grow_cluster(const Cloud& cloud, std::uint32_t seed,
                                        const Eigen::Vector3f& down,
                                        const PaperGrowingParams& params, const ReachParams& reach,
                                        NeighborSearch& search) {
  const ReachCylinder cylinder(cloud.points_m[seed], down, reach);
  search.reset();
  search.name(seed);
  std::vector<std::uint32_t> cluster = {seed}, neighbors;
  for (std::size_t i = 0; i < cluster.size() && i < static_cast<std::size_t>(params.max_iterations);
       ++i) {
    neighbors.clear();
    search.take_neighbors(cluster[i], params.max_distance_m, neighbors);
    for (const std::uint32_t neighbor : neighbors) {
      if (cylinder.contains(cloud.points_m[neighbor])) cluster.push_back(neighbor);
    }
  }
  return cluster;
}

}  // namespace limbcast::segmenter
