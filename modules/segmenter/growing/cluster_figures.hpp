#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"

namespace limbcast::segmenter {

/// What tells a person's cluster from another's; lengths level frame, "height" counted from the
/// head's centre.
struct ClusterFigures {
  int points = 0;                       ///< of the lattice
  float area_m2 = 0.0F;                 ///< facing the sensor
  float head_width_m = 0.0F;            ///< across, within 7 cm of the head's height
  float shoulder_width_m = 0.0F;        ///< across, 20 to 42 cm below the head
  float torso_width_m = 0.0F;           ///< across, 45 to 70 cm below the head
  float drop_m = 0.0F;                  ///< from the head to the lowest points (1 %)
  float rise_m = 0.0F;                  ///< from the head to the highest points (0.5 %)
  float edge_share = 0.0F;              ///< points in the outer 15 cm of the reach cylinder
  float over_head_share = 0.0F;         ///< points 14 cm and more over the head, near its axis
  float offset_m = 0.0F;                ///< across, from the head to the cluster's median
  float seed_over_centroid_m = 0.0F;    ///< along gravity
  float seed_beside_centroid_m = 0.0F;  ///< level distance
  float density = 0.0F;           ///< share of the rays through the cluster's outline that hit it
  float head_relief_m = 0.0F;     ///< how far the head's middle stands before its rim, 10 cm off
  float head_roughness_m = 0.0F;  ///< median distance of its points from a paraboloid
  float torso_depth_m = 0.0F;     ///< spread away from the sensor, 20 to 70 cm below the head
  float open_share = 0.0F;        ///< points whose surface goes on beyond the cluster
};

/// Figures of the cluster whose points carry `label`.
ClusterFigures measure_cluster(const Lattice& lattice, const HeadCandidate& head,
                               const std::vector<std::int16_t>& labels, std::int16_t label,
                               const JointGrowingParams& growing, const ReachParams& reach);

/// Figures of each cluster; `labels` as grow_together gives them.
std::vector<ClusterFigures> measure_clusters(const Lattice& lattice,
                                             const std::vector<HeadCandidate>& heads,
                                             const std::vector<std::int16_t>& labels,
                                             const JointGrowingParams& growing,
                                             const ReachParams& reach);

}  // namespace limbcast::segmenter
