#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "modules/segmenter/growing/neighbor_search.hpp"
#include "modules/segmenter/params.hpp"

namespace limbcast::segmenter {

/// The cylinder a human can reach, about the axis along gravity through a seed.
class ReachCylinder {
 public:
  ReachCylinder(const Eigen::Vector3f& seed_m, const Eigen::Vector3f& down,
                const ReachParams& params)
      : seed_m_(seed_m), down_(down), params_(params) {}
  bool contains(const Eigen::Vector3f& point_m) const;

 private:
  Eigen::Vector3f seed_m_, down_;
  ReachParams params_;
};

/// Algorithm 1 of the paper: from the seed, all neighbours within d_max that lie in the cylinder,
/// then those of the cluster's next point, until there is none left or i_max points were looked at.
/// Returns the cluster's indices in the order they were added, the seed first.
std::vector<std::uint32_t> grow_cluster(const Cloud& cloud, std::uint32_t seed,
                                        const Eigen::Vector3f& down,
                                        const PaperGrowingParams& params, const ReachParams& reach,
                                        NeighborSearch& search);

}  // namespace limbcast::segmenter
