#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/cloud/cloud.hpp"

namespace limbcast::segmenter {

/// Answers Algorithm 1's "detect neighbors": the points of a cloud within d_max of one of them that
/// no earlier answer has named. Each point is named once; who grows a cluster wants no point twice.
class NeighborSearch {
 public:
  virtual ~NeighborSearch() = default;
  /// Forgets what was named.
  virtual void reset() = 0;
  /// Marks a point as named.
  virtual void name(std::uint32_t index) = 0;
  /// Appends the unnamed points within `radius_m` of point `index`, in the cloud's order, and names
  /// them.
  virtual void take_neighbors(std::uint32_t index, float radius_m,
                              std::vector<std::uint32_t>& neighbors) = 0;
};

/// For any cloud: a kd-tree over all points (Bentley 1975; nanoflann), as in the paper. `cloud`
/// must outlive it.
std::unique_ptr<NeighborSearch> make_kd_tree_search(const Cloud& cloud);

/// For an organised cloud: the window of pixels that a ball of the radius can cover. Names exactly
/// the points that the kd-tree names. `cloud` must outlive it.
std::unique_ptr<NeighborSearch> make_lattice_search(const Cloud& cloud);

}  // namespace limbcast::segmenter
