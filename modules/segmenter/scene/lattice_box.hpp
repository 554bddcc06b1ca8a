#pragma once

#include <algorithm>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "modules/segmenter/scene/lattice.hpp"

namespace limbcast::segmenter {

/// The pixels that hold all of the points, which are told row by row; empty without any.
inline cv::Rect box_around(const Lattice& lattice, const std::vector<std::uint32_t>& points) {
  if (points.empty()) return {};
  int left = lattice.width, right = 0;
  for (const std::uint32_t i : points) {
    const int u = static_cast<int>(i) % lattice.width;
    left = std::min(left, u);
    right = std::max(right, u);
  }
  const int top = static_cast<int>(points.front()) / lattice.width;
  const int bottom = static_cast<int>(points.back()) / lattice.width;
  return {left, top, right - left + 1, bottom - top + 1};
}

}  // namespace limbcast::segmenter
