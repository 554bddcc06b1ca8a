#pragma once

#include <cstdint>
#include <vector>

#include "modules/pose_fitter/refined/body_model.hpp"

namespace limbcast::pose_fitter::refined {

/// Unknowns that a step may change, in the order of elimination.
struct UnknownSet {
  std::array<int, kUnknownCount> unknowns;
  int count = 0;
  std::array<bool, kUnknownCount> contains{};
  /// Where a Hessian of all unknowns holds the lower triangle of these, column by column.
  std::vector<std::uint16_t> hessian_places;
};
/// The unknowns of those parts. A single arm is its points from the shoulder on; with the trunk
/// come size and rotation.
const UnknownSet& unknowns_of(unsigned parts);

}  // namespace limbcast::pose_fitter::refined
