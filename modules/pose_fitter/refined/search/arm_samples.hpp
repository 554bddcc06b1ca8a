#pragma once

#include <vector>

#include "modules/pose_fitter/refined/observation.hpp"

namespace limbcast::pose_fitter::refined {

/// Places on arms whose costs are looked for together, in columns.
struct ArmSamples {
  std::vector<Real> x, y, z, radius;  ///< [m]
  std::vector<Real> u, v;             ///< pixel; of those beyond the grid any
  std::vector<Real> elsewhere;        ///< cost of what has no pixel, else 0
  /// What was seen at the pixel, the depth's spread there, and how little other parts explain it.
  std::vector<Real> clearance_px, surface_m, sigma_m, unexplained;
  std::vector<Real> cost;

  std::size_t size() const { return x.size(); }
  void clear();
  void add(const Vec3& center, Real radius_m);
};

/// Makes the columns as long as samples were added, and finds their pixels.
void find_pixels(const Observation& observation, ArmSamples& samples);
/// Sums up what was seen there.
void weigh(Real fx_px, ArmSamples& samples);

}  // namespace limbcast::pose_fitter::refined
