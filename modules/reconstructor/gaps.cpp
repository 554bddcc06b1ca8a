#include "modules/reconstructor/gaps.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "common/simd.hpp"
#include "modules/reconstructor/marks.hpp"

namespace limbcast::reconstructor {
namespace {

/// Disparities `num_steps` apart, `step` pixels each, with a gap between them, are joined by a
/// line.
void bridge(float* first, std::ptrdiff_t step, int num_steps) {
  const float slope = (first[num_steps * step] - *first) / static_cast<float>(num_steps);
  for (int i = 1; i < num_steps; ++i) first[i * step] = *first + static_cast<float>(i) * slope;
}

LIMBCAST_SIMD void mark_seen(const float* __restrict disparity_px, int count,
                             std::uint8_t* __restrict is_seen) {
  for (int i = 0; i < count; ++i) is_seen[i] = disparity_px[i] > 0.0F ? 1 : 0;
}

/// Marks the columns in which a row ends a gap. `rows_before` and `px_before` are each column's
/// last row with a disparity, and that.
LIMBCAST_SIMD void mark_ends(const float* __restrict row, std::int32_t v, const GapParams& params,
                             int count, const std::int32_t* __restrict rows_before,
                             const float* __restrict px_before, std::uint8_t* __restrict is_end) {
  const std::int32_t longest = params.max_length_px + 1;
  const float same_surface_px = params.same_surface_px;
  for (int u = 0; u < count; ++u) {
    const std::int32_t num_steps = v - rows_before[u];
    is_end[u] = static_cast<std::uint8_t>(
        static_cast<int>(row[u] > 0.0F) & static_cast<int>(num_steps > 1) &
        static_cast<int>(num_steps <= longest) &
        static_cast<int>(std::abs(row[u] - px_before[u]) < same_surface_px));
  }
}

/// Makes a row the last one where it has a disparity.
LIMBCAST_SIMD void keep_last(const float* __restrict row, std::int32_t v, int count,
                             std::int32_t* __restrict rows_before, float* __restrict px_before) {
  for (int u = 0; u < count; ++u) {
    rows_before[u] = row[u] > 0.0F ? v : rows_before[u];
    px_before[u] = row[u] > 0.0F ? row[u] : px_before[u];
  }
}

/// Fills gaps row by row; those in columns when the row below them comes.
class GapFiller {
 public:
  GapFiller(const GapParams& params, int width)
      : params_(params),
        marks_(width),
        rows_before_(width, -params.max_length_px - 2),  // too far above the image to be of it
        px_before_(width, 0.0F) {}

  void fill(int v, cv::Mat1f& disparity_px) {
    const int width = disparity_px.cols;
    float* row = disparity_px[v];
    mark_seen(row, width, marks_.data());
    int gap = find_mark(marks_, find_mark(marks_, 0), 0);
    for (int end = find_mark(marks_, gap); end < width; end = find_mark(marks_, gap)) {
      if (end - gap <= params_.max_length_px &&
          std::abs(row[end] - row[gap - 1]) < params_.same_surface_px)
        bridge(row + gap - 1, 1, end - gap + 1);
      gap = find_mark(marks_, end, 0);
    }
    fill_columns(v, disparity_px);
  }

 private:
  void fill_columns(int v, cv::Mat1f& disparity_px) {
    const int width = disparity_px.cols;
    const auto step = static_cast<std::ptrdiff_t>(disparity_px.step1());
    mark_ends(disparity_px[v], v, params_, width, rows_before_.data(), px_before_.data(),
              marks_.data());
    for (int u = find_mark(marks_, 0); u < width; u = find_mark(marks_, u + 1))
      bridge(disparity_px[rows_before_[u]] + u, step, v - rows_before_[u]);
    keep_last(disparity_px[v], v, width, rows_before_.data(), px_before_.data());
  }

  GapParams params_;
  std::vector<std::uint8_t> marks_;
  std::vector<std::int32_t> rows_before_;
  std::vector<float> px_before_;
};

}  // namespace

void fill_gaps(const GapParams& params, cv::Mat1f& disparity_px) {
  GapFiller filler(params, disparity_px.cols);
  for (int v = 0; v < disparity_px.rows; ++v) filler.fill(v, disparity_px);
}

}  // namespace limbcast::reconstructor
