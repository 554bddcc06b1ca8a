#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "modules/segmenter/growing/filters.hpp"
#include "modules/segmenter/growing/neighbor_search.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"

namespace limbcast::segmenter {

/// A cluster that Algorithm 1 grew, and the filter that ended it.
struct PaperCluster {
  HeadCandidate seed;
  std::vector<std::uint32_t> points;  ///< indices of the cloud
  ClusterFigures figures;
  std::optional<Rejection> rejection;
};

/// The paper's segmentation (III-B): one cluster for each seed, the four filters, and of the
/// clusters that are one person the one that was grown from the head. People first, in the order of
/// the seeds.
std::vector<PaperCluster> find_people_as_paper(const Cloud& cloud, const Lattice& lattice,
                                               const std::vector<HeadCandidate>& seeds,
                                               NeighborSearch& search, const Params& params);

}  // namespace limbcast::segmenter
