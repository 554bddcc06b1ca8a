#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

namespace limbcast::reconstructor {

/// Census transform (Zabih, Woodfill, ECCV 1994): one bit for each neighbour, set where it is
/// clearly brighter than the pixel. Eight neighbours to a plane, so that a loop over pixels handles
/// as many pixels as a register has bytes.
struct Census {
  static constexpr int kNumPlanes = 3;
  /// Most bits in which two pixels can differ.
  static constexpr int kNumBits = 8 * kNumPlanes;
  std::array<cv::Mat1b, kNumPlanes> planes;
};

/// Of an 8-bit image; beyond its borders the border's pixels are repeated.
Census census_of(const cv::Mat1b& grey);

}  // namespace limbcast::reconstructor
