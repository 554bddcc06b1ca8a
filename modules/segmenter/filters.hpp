#pragma once

#include <optional>

#include "common/cloud/segment.hpp"
#include "modules/segmenter/cluster_figures.hpp"
#include "modules/segmenter/params.hpp"

namespace limbcast::segmenter {

/// Why a cluster is no person, and by what figure.
struct Rejection {
  SegmentFilter filter;
  float figure;
  float limit;
};

/// The four filters of section III-B.2 in the paper's order; nothing for a cluster that passes all.
/// `point_area_m2`: surface that one point of the cluster stands for, facing the sensor (mean).
std::optional<Rejection> check_validity(const ClusterFigures& figures, const FilterParams& params);

}  // namespace limbcast::segmenter
