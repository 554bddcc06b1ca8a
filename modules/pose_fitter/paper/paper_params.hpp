#pragma once

#include <string>

#include "common/human_model/human_model.hpp"
#include "modules/pose_fitter/pointing.hpp"

namespace limbcast::pose_fitter {

/// Eq. 2 "computes the median s of the scales" and writes a mean.
enum class ScaleAverage { kMean, kMedian };

/// The deviation that the 2 sigma rule takes (README, "The 2 sigma rule").
enum class ScaleDeviation {
  kFixed,  ///< PaperFitterParams::scale_sigma
  kPose,   ///< that of the pose's own scales: throws most good poses out
};

/// Numbers of the paper's sections III-A and III-C, which gives none of them. Those without another
/// origin were chosen on bodies D1 to D3 of stereo_dev; README.md has the figures.
struct PaperFitterParams {
  HumanModelFiles model_files;
  /// Times the poses are fitted, each time with the lengths that Eq. 2 found before, as long as
  /// they change by more than rescale_above. 1: never again; children then fit badly.
  int max_passes = 3;
  double rescale_above = 0.12;

  // The cluster
  /// Points are averaged in cubes of this edge [m], so that densities mean the same for a camera
  /// and a laser scanner, near and far. Smaller: slower, finer.
  double voxel_m = 0.025;
  /// Points are moved this far along their rays [m]: the sensor sees the skin, links lie inside.
  double inward_m = 0.05;
  /// Points farther from the head than a person reaches are left out [m].
  double reach_m = 2.0;
  /// A cluster of fewer averaged points is no person.
  int min_points = 60;

  // Find best fit
  /// Radius around the reference point in which link ends are searched [m].
  double near_radius_m = 0.22;
  /// A link may point this far away from the reference's direction [deg].
  double max_link_turn_deg = 60.0;
  /// A link may bend this much against the one it hangs on [deg]: the largest interval of an elbow
  /// (AAOS 1965: 150).
  double max_bend_deg = 150.0;
  /// Averaged points within 6 cm of the link that count as dense; more do not improve a link.
  double dense_points = 8.0;
  /// No place along the link may have fewer.
  double min_points_along_link = 1.0;
  /// Weights of e2 in Algorithm 2, e1 (1 - density / dense_points) having 1: difference of length,
  /// of direction (1 - cosine) and distance from the reference point (of near_radius_m).
  double length_weight = 1.0, direction_weight = 0.5, distance_weight = 1.0;

  // Eq. 1
  double alpha_distance = 1.5;         ///< for one metre between reference and detected end
  double alpha_missing = 1.0;          ///< for one missing link
  double alpha_unused = 10.0;          ///< for a cluster of which no point is near the pose
  double alpha_density = 0.3;          ///< for one link of low density
  double missing_inner_penalty = 1.0;  ///< a_i of a link that others hang on
  double missing_outer_penalty = 0.5;  ///< a_i of a link that none hangs on
  double low_density_points = 3.0;     ///< mean along a link below which it is penalised

  // Validity
  ScaleAverage scale_average = ScaleAverage::kMean;
  ScaleDeviation scale_deviation = ScaleDeviation::kFixed;
  double scale_sigma = 0.12;  ///< of a link's length over its reference, body and sensor together
  /// Limits of angles hold up to the error of end points: 6 cm over an upper arm of 25 cm [deg].
  double angle_tolerance_deg = 15.0;

  PointingParams pointing;
};

}  // namespace limbcast::pose_fitter
