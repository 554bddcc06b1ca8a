#pragma once

#include <optional>

#include "common/cloud/segment.hpp"
#include "modules/segmenter/growing/cluster_figures.hpp"
#include "modules/segmenter/params.hpp"

namespace limbcast::segmenter {

/// Of two seeds one of which holds more than this share of the other one's points, both are the
/// same person's.
inline constexpr float kSamePersonShare = 0.5F;

/// Why a cluster is no person, and by what figure.
struct Rejection {
  SegmentFilter filter;
  float figure;
  float limit;
};

/// The four filters of section III-B.2 in the paper's order; nothing for a cluster that passes all.
std::optional<Rejection> check_validity(const ClusterFigures& figures, const FilterParams& params);

}  // namespace limbcast::segmenter
