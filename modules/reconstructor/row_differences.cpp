#include "modules/reconstructor/row_differences.hpp"

#include <cmath>

#include "common/median.hpp"

namespace limbcast::reconstructor {

std::vector<double> row_differences_px(const RectifiedPair& pair) {
  std::vector<double> differences_px;
  for (const CornerTrack& corner : track_corners(pair))
    differences_px.push_back(corner.right.y - corner.left.y);
  return differences_px;
}

double median_size_px(std::vector<double> differences_px) {
  for (double& difference_px : differences_px) difference_px = std::abs(difference_px);
  return median(std::move(differences_px));
}

}  // namespace limbcast::reconstructor
