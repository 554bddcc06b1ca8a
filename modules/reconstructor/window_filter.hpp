#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace limbcast::reconstructor {

/// First pixels of a window's rows, or of its columns.
template <int window_px>
using Taps = std::array<const float*, window_px>;

/// Applies `filter(taps, count, result)` along rows, then along columns, row by row, so that all
/// of it stays in the cache. Outside the image everything is 0.
template <int window_px, typename Filter>
class WindowFilter {
 public:
  static constexpr int kRadiusPx = window_px / 2;

  WindowFilter(int width, Filter filter)
      : width_(width), filter_(std::move(filter)), padded_(width + 2 * kRadiusPx, 0.0F) {
    for (auto& row : filtered_) row.assign(width, 0.0F);
  }
  /// Takes the image's next row, or nullptr below the last.
  void push(const float* row) {
    std::rotate(filtered_.begin(), filtered_.begin() + 1, filtered_.end());
    if (row == nullptr) {
      std::fill(filtered_.back().begin(), filtered_.back().end(), 0.0F);
      return;
    }
    std::copy_n(row, width_, padded_.begin() + kRadiusPx);
    Taps<window_px> taps{};
    for (int i = 0; i < window_px; ++i) taps[i] = padded_.data() + i;
    filter_(taps, width_, filtered_.back().data());
  }
  /// The result for the row that was pushed kRadiusPx rows ago.
  void pull(float* result) const {
    Taps<window_px> taps{};
    for (int i = 0; i < window_px; ++i) taps[i] = filtered_[i].data();
    filter_(taps, width_, result);
  }

 private:
  int width_;
  Filter filter_;
  std::vector<float> padded_;
  std::array<std::vector<float>, window_px> filtered_;
};

}  // namespace limbcast::reconstructor
