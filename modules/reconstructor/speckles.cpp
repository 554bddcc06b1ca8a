#include "modules/reconstructor/speckles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "common/simd.hpp"
#include "modules/reconstructor/marks.hpp"

namespace limbcast::reconstructor {
namespace {

/// Disparities are compared in whole sixteenths of a pixel.
constexpr float kSteps = 16.0F;
/// Rounds numbers below 2^22 to whole ones when it is added and taken off again.
constexpr float kRounder = 12582912.0F;  // 1.5 * 2^23

/// Pixels of a row that hang together.
struct Run {
  int row, begin, end;
};

/// Which runs hang together, and how many pixels they have.
class Groups {
 public:
  void add(int num_pixels) {
    parents_.push_back(static_cast<int>(parents_.size()));
    num_pixels_.push_back(num_pixels);
  }
  int root(int run) {
    while (parents_[run] != run) run = parents_[run] = parents_[parents_[run]];
    return run;
  }
  void join(int a, int b) {
    const int root_a = root(a), root_b = root(b);
    if (root_a == root_b) return;
    parents_[root_b] = root_a;
    num_pixels_[root_a] += num_pixels_[root_b];
  }
  int num_pixels(int run) { return num_pixels_[root(run)]; }

 private:
  std::vector<int> parents_, num_pixels_;  ///< the latter of roots
};

LIMBCAST_SIMD void round_to_steps(const float* __restrict disparity_px, int count,
                                  float* __restrict rounded) {
  for (int i = 0; i < count; ++i) rounded[i] = disparity_px[i] * kSteps + kRounder - kRounder;
}

/// 1 where two pixels do not hang together, 0 where they do; no pixel does with a hole.
LIMBCAST_SIMD void mark_breaks(const float* __restrict here, const float* __restrict neighbour,
                               float max_step, int count, std::uint8_t* __restrict is_break) {
  for (int i = 0; i < count; ++i) {
    const int is_step = static_cast<int>(std::abs(here[i] - neighbour[i]) > max_step);
    is_break[i] = static_cast<std::uint8_t>(is_step | static_cast<int>(here[i] == 0.0F) |
                                            static_cast<int>(neighbour[i] == 0.0F));
  }
}

/// Takes an image's rows from above to below.
class SpeckleFinder {
 public:
  SpeckleFinder(const SpeckleParams& params, int width)
      : params_(params),
        max_step_(std::floor(params.max_step_px * kSteps)),
        here_(width),
        above_(width, 0.0F),
        is_break_(width) {}

  void push(int v, const float* disparity_px) {
    const int width = static_cast<int>(here_.size());
    round_to_steps(disparity_px, width, here_.data());
    mark_breaks(here_.data() + 1, here_.data(), max_step_, width - 1, is_break_.data() + 1);
    const std::size_t first_above = first_of_row_, first = runs_.size();
    find_runs(v);
    mark_breaks(here_.data(), above_.data(), max_step_, width, is_break_.data());
    join_runs(first_above, first);
    first_of_row_ = first;
    std::swap(here_, above_);
  }

  void remove(cv::Mat1f& disparity_px) {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (groups_.num_pixels(static_cast<int>(i)) > params_.max_size_px) continue;
      float* row = disparity_px[runs_[i].row];
      std::fill(row + runs_[i].begin, row + runs_[i].end, 0.0F);
    }
  }

 private:
  void find_runs(int v) {
    const int width = static_cast<int>(here_.size());
    for (int u = 0; u < width;) {
      if (here_[u] == 0.0F) {
        ++u;
        continue;
      }
      const int end = find_mark(is_break_, u + 1);
      runs_.push_back({v, u, end});
      groups_.add(end - u);
      u = end;
    }
  }

  /// Runs of the row above (from `above` to `here`) and of this row (from `here` on) that touch.
  void join_runs(std::size_t above, std::size_t here) {
    const std::size_t end_above = here;
    while (above < end_above && here < runs_.size()) {
      const int begin = std::max(runs_[above].begin, runs_[here].begin);
      const int end = std::min(runs_[above].end, runs_[here].end);
      const auto first = is_break_.begin() + begin;
      if (begin < end && std::find(first, is_break_.begin() + end, 0) != is_break_.begin() + end)
        groups_.join(static_cast<int>(above), static_cast<int>(here));
      ++(runs_[above].end < runs_[here].end ? above : here);
    }
  }

  SpeckleParams params_;
  float max_step_;                   ///< in kSteps
  std::vector<float> here_, above_;  ///< rows in kSteps
  std::vector<std::uint8_t> is_break_;
  std::vector<Run> runs_;
  std::size_t first_of_row_ = 0;
  Groups groups_;
};

}  // namespace

void remove_speckles(const SpeckleParams& params, cv::Mat1f& disparity_px) {
  if (disparity_px.empty()) return;
  SpeckleFinder finder(params, disparity_px.cols);
  for (int v = 0; v < disparity_px.rows; ++v) finder.push(v, disparity_px[v]);
  finder.remove(disparity_px);
}

}  // namespace limbcast::reconstructor
