#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "modules/reconstructor/byte_lanes.hpp"
#include "modules/reconstructor/census.hpp"
#include "modules/reconstructor/even_background.hpp"

namespace limbcast::reconstructor {

/// Above any sum along a path that could be the lowest, and low enough that sums stay within a
/// byte.
constexpr std::uint8_t kNoMatch = 127;

/// Costs of matching pixels of the left image with pixels of the right one.
class MatchingCosts {
 public:
  MatchingCosts(const cv::Mat1b& left, const cv::Mat1b& right, int num_disparities,
                const EvenBackgroundParams& background);
  /// Bytes of a pixel's costs.
  int size() const { return static_cast<int>(least_.size()); }
  /// Differing bits of the census of each pixel u of row v and the right image's pixel u - d, at
  /// costs[u * size() + d]. Left of the image its border is repeated.
  void compute_row(int v, std::uint8_t* costs) const;

 private:
  Census left_, right_mirrored_;  ///< mirrored, so that disparities grow with the address
  cv::Mat1b background_;          ///< 255 where the left image is even and shows background
  /// What the costs are at least, and there.
  std::vector<std::uint8_t> least_, background_least_;
};

}  // namespace limbcast::reconstructor
