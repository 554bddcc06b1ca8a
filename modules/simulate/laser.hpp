#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/simulate/random.hpp"
#include "modules/simulate/raycast.hpp"

namespace limbcast::simulate {

/// A range finder that sweeps a grid of angles: rings of a rotating one, or the lines of a tilting
/// one.
struct LaserParams {
  int rings = 64;  ///< rows
  double min_elevation_deg = -22.5, max_elevation_deg = 22.5;
  double min_azimuth_deg = -90.0, max_azimuth_deg = 90.0;  ///< 0 = along z, positive to the right
  double azimuth_step_deg = 0.2;
  double range_sigma_m = 0.010;  ///< as in data/laser_dev
  /// How far each ring's range and azimuth are off, the same in a whole scan: what calibration
  /// leaves of real scanners' lasers.
  double ring_range_sigma_m = 0.0, ring_azimuth_sigma_deg = 0.0;
  double max_range_m = 25.0;
  double lost_share = 0.005;      ///< of the returns, at random
  double edge_beam_rad = 0.0015;  ///< half the beam's width: at edges it averages front and back
  bool organised = false;         ///< keep the grid, NaN where nothing came back
};

struct LaserScan {
  int width = 0, height = 0;  ///< height 1 where not organised
  std::vector<Eigen::Vector3f> points_m;
  std::vector<float> intensities;  ///< 0 to 100
  std::vector<int> persons;        ///< person at each point, 0 = none; for judging only
};

LaserScan scan(const World& world, const LaserParams& params, Rng rng);

}  // namespace limbcast::simulate
