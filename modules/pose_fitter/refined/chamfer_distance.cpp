#include "modules/pose_fitter/refined/chamfer_distance.hpp"

#include <algorithm>

#include "common/simd.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Lengths of steps, 0.955 and 1.3693 px, in fractions of a pixel.
constexpr int kFractions = 1 << 16, kStraight = 62587, kDiagonal = 89738;
/// Of a pixel that no zero is known for yet; with a step still no overflow.
constexpr int kFar = 1 << 29;

/// By way of the three neighbours in the row before.
LIMBCAST_SIMD void step_from_row(const int* before, int width, int* row) {
  LIMBCAST_INDEPENDENT_ROUNDS
  for (int u = 0; u < width; ++u) {
    const int left = before[u - 1] + kDiagonal, middle = before[u] + kStraight,
              right = before[u + 1] + kDiagonal;
    const int beside = left < right ? left : right, nearest = beside < middle ? beside : middle;
    row[u] = row[u] < nearest ? row[u] : nearest;
  }
}

/// By way of the neighbour before, in the direction of `step`.
void step_along_row(int* begin, int count, int step) {
  int nearest = kFar;
  for (int i = 0; i < count; ++i, begin += step)
    *begin = nearest = std::min(*begin, nearest + kStraight);
}

}  // namespace

std::vector<float> chamfer_distance(const std::vector<std::uint8_t>& pixels, int width,
                                    int height) {
  // A border on all sides.
  const int stride = width + 2;
  std::vector<int> distances(static_cast<std::size_t>(stride) * (height + 2), kFar);
  const auto row = [&](int v) {
    return &distances[static_cast<std::size_t>(stride) * (v + 1) + 1];
  };
  for (int v = 0; v < height; ++v) {
    const std::uint8_t* const own = &pixels[static_cast<std::size_t>(width) * v];
    for (int u = 0; u < width; ++u) row(v)[u] = own[u] == 0 ? 0 : kFar;
    step_from_row(row(v - 1), width, row(v));
    step_along_row(row(v), width, 1);
  }
  std::vector<float> result(pixels.size());
  for (int v = height - 1; v >= 0; --v) {
    step_from_row(row(v + 1), width, row(v));
    step_along_row(row(v) + width - 1, width, -1);
    for (int u = 0; u < width; ++u) {
      result[static_cast<std::size_t>(width) * v + u] =
          static_cast<float>(std::min(row(v)[u], kFar)) * (1.0F / kFractions);
    }
  }
  return result;
}

}  // namespace limbcast::pose_fitter::refined
