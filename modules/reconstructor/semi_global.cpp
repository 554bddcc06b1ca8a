#include "modules/reconstructor/semi_global.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <vector>

#include "common/simd.hpp"
#include "modules/reconstructor/byte_lanes.hpp"
#include "modules/reconstructor/lowest_costs.hpp"
#include "modules/reconstructor/matching_costs.hpp"

// Costs and sums are bytes, those of a pixel's disparities side by side. Rows are worked on from
// above to below, a few at a time, so that what is worked on stays in the cache: of a strip of rows
// only the sums of the path from below, which has to come first, are kept; costs are rather
// computed twice.
namespace limbcast::reconstructor {
namespace {

using Byte = std::uint8_t;

/// Rows that are matched together.
constexpr int kStripRows = 64;
/// Rows above and below a strip where its vertical paths begin.
constexpr int kRunUpRows = 16;
/// Rows whose horizontal paths go side by side: each step waits for the one before, and meanwhile
/// the processor does the other rows'.
constexpr int kGroupRows = 4;

/// Bytes before and after a pixel's sums, which stand for disparities that are not searched.
constexpr int kGap = 16;
constexpr Byte kTooHigh = 200;

/// Sums along a path for pixels one after the other.
class PathSums {
 public:
  /// Room for pixels whose costs are `size` bytes.
  void reshape(int num_pixels, int size) {
    if (num_pixels == num_pixels_ && size == size_) return;
    num_pixels_ = num_pixels;
    size_ = size;
    bytes_.assign(kGap + static_cast<std::size_t>(num_pixels) * (size + kGap), kTooHigh);
  }
  /// As before a path's first pixel.
  void set_to_zero() {
    for (int i = 0; i < num_pixels_; ++i) std::fill_n(pixel(i), size_, Byte{0});
  }
  Byte* pixel(int index) {
    return &bytes_[kGap + static_cast<std::size_t>(index) * (size_ + kGap)];
  }

 private:
  int num_pixels_ = 0, size_ = 0;
  std::vector<Byte> bytes_;
};

/// What all paths share.
struct PathShape {
  int width;          ///< pixels of a row
  int num_registers;  ///< of a pixel's costs
  Byte small_step;
};

/// Room for matching a strip, kept from one to the next: asking the system for it each time takes
/// longer than filling it.
struct Workspace {
  std::vector<PathSums> from_below;  ///< of each row of the strip
  std::array<PathSums, 2> run_up;    ///< of the rows below it
  /// [pixel][disparity], and room for a register before and after.
  std::array<std::vector<Byte>, kGroupRows> costs;
  std::array<PathSums, kGroupRows> from_left;   ///< of what is left of the row, then of its pixels
  std::array<PathSums, kGroupRows> from_right;  ///< of the last two pixels
  std::array<PathSums, kGroupRows> from_above;
  std::vector<Byte> lowest;                ///< of the vertical paths
  std::vector<Byte> left, right_mirrored;  ///< disparities, see LowestCosts
};

/// Where a group's rows stand, pixel after pixel.
struct RowGroup {
  int num_rows;
  std::array<const Byte*, kGroupRows> horizontal_steps;  ///< large step from the left neighbour
  std::array<Byte*, kGroupRows> costs, from_left, from_right, from_above, from_below;
};

/// One step of a path, from the pixel before to this one:
/// L(d) = C(d) + min(L'(d), L'(d - 1) + P1, L'(d + 1) + P1, min L' + P2) - min L'.
/// Returns min L.
LIMBCAST_INLINE inline Byte advance(const Byte* cost, const Byte* before, Byte lowest_before,
                                    Byte small_step, Byte large_step, int size, Byte* now) {
  const Lanes jump = Lanes{} + static_cast<Byte>(lowest_before + large_step);
  Lanes lowest = ~Lanes{};
  for (int d = 0; d < size; d += kCostsInARegister) {
    Lanes best, below, above, costs;
    load(before + d, best);
    load(before + d - 1, below);
    load(before + d + 1, above);
    load(cost + d, costs);
    lower_to(below, above);
    above += small_step;
    lower_to(jump, best);
    lower_to(above, best);
    best += costs - lowest_before;
    store(best, now + d);
    lower_to(best, lowest);
  }
  return lowest_of(lowest);
}

/// A step of the vertical paths, from the row before to this one; `lowest` is min L of each pixel.
LIMBCAST_SIMD void advance_row(const PathShape& shape, const Byte* cost, const Byte* large_steps,
                               const Byte* before, Byte* lowest, Byte* now) {
  with_size(shape.num_registers, [&](auto size) LIMBCAST_INLINE {
    for (int u = 0; u < shape.width; ++u) {
      lowest[u] = advance(cost, before, lowest[u], shape.small_step, large_steps[u], size, now);
      cost += size;
      before += size + kGap;
      now += size + kGap;
    }
  });
}

LIMBCAST_SIMD void advance_from_left(const PathShape& shape, RowGroup group) {
  with_size(shape.num_registers, [&](auto size) LIMBCAST_INLINE {
    std::array<Byte, kGroupRows> lowest{};
    for (int u = 0; u < shape.width; ++u) {
      for (int i = 0; i < group.num_rows; ++i) {
        Byte* before = group.from_left[i];
        group.from_left[i] += size + kGap;
        lowest[i] = advance(group.costs[i], before, lowest[i], shape.small_step,
                            group.horizontal_steps[i][u], size, group.from_left[i]);
        group.costs[i] += size;
      }
    }
  });
}

/// The last path. With its sums, the means of all four take the costs' place.
LIMBCAST_SIMD void advance_from_right(const PathShape& shape, RowGroup group) {
  with_size(shape.num_registers, [&](auto size) LIMBCAST_INLINE {
    std::array<Byte, kGroupRows> lowest{};
    for (int u = shape.width - 1; u >= 0; --u) {
      const int before = std::min(u + 1, shape.width - 1);
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(u) * (size + kGap);
      for (int i = 0; i < group.num_rows; ++i) {
        Byte* __restrict costs = group.costs[i] + static_cast<std::ptrdiff_t>(u) * size;
        Byte* __restrict right = group.from_right[i] + u % 2 * (size + kGap);
        lowest[i] = advance(costs, group.from_right[i] + (u + 1) % 2 * (size + kGap), lowest[i],
                            shape.small_step, group.horizontal_steps[i][before], size, right);
        const Byte* __restrict left = group.from_left[i] + at + size + kGap;
        const Byte* __restrict above = group.from_above[i] + at;
        const Byte* __restrict below = group.from_below[i] + at;
        for (int d = 0; d < size; ++d) {
          const auto horizontal = static_cast<Byte>(left[d] + right[d]);
          const auto vertical = static_cast<Byte>(above[d] + below[d]);
          costs[d] = static_cast<Byte>((horizontal + vertical + 1) >> 1);
        }
      }
    }
  });
}

cv::Mat1b large_step_costs(const cv::Mat1b& grey, const SemiGlobalParams& params) {
  cv::Mat1b table(1, 256);
  for (int difference = 0; difference < table.cols; ++difference) {
    const int cost = params.large_step_cost * params.even_grey_levels /
                     std::max(difference, params.even_grey_levels);
    table(difference) = static_cast<Byte>(std::max(cost, params.small_step_cost));
  }
  cv::Mat1b before, difference, costs;
  cv::copyMakeBorder(grey.rowRange(0, grey.rows - 1), before, 1, 0, 0, 0, cv::BORDER_REPLICATE);
  cv::absdiff(grey, before, difference);
  cv::LUT(difference, table, costs);
  return costs;
}

/// Matches strips of rows, each by itself.
class StripMatcher {
 public:
  StripMatcher(const cv::Mat1b& left, const cv::Mat1b& right, const SemiGlobalParams& params)
      : params_(params),
        width_(left.cols),
        height_(left.rows),
        costs_(left, right, params.num_disparities, params.even_background),
        vertical_steps_(large_step_costs(left, params)),
        horizontal_steps_(large_step_costs(left.t(), params).t()),
        shape_{width_, costs_.size() / kCostsInARegister,
               static_cast<Byte>(params.small_step_cost)},
        lowest_(width_, costs_.size(), params.num_disparities) {}

  void match(int begin, int end, Workspace& work, cv::Mat1f& disparity_px) const {
    reshape(work);
    sum_from_below(begin, end, work);
    begin_from_above(begin, work);
    for (int v = begin; v < end; v += kGroupRows) {
      const int num_rows = std::min(kGroupRows, end - v);
      for (int i = 0; i < num_rows; ++i) advance_from_above(v + i, work);
      const RowGroup group = group_of(begin, v, num_rows, work);
      advance_from_left(shape_, group);
      advance_from_right(shape_, group);
      for (int i = 0; i < num_rows; ++i) choose(costs_of(i, work), work, disparity_px[v + i]);
    }
  }

 private:
  void reshape(Workspace& work) const {
    work.from_below.resize(kStripRows);
    for (PathSums& sums : work.from_below) sums.reshape(width_, costs_.size());
    for (PathSums& sums : work.run_up) sums.reshape(width_, costs_.size());
    for (int i = 0; i < kGroupRows; ++i) {
      work.costs.at(i).resize(static_cast<std::size_t>(width_) * costs_.size() +
                              2 * kCostsInARegister);
      work.from_left.at(i).reshape(width_ + 1, costs_.size());
      work.from_right.at(i).reshape(2, costs_.size());
      work.from_above.at(i).reshape(width_, costs_.size());
    }
    work.left.resize(width_);
    work.right_mirrored.resize(width_ + kCostsInARegister);
  }

  static Byte* costs_of(int row_of_group, Workspace& work) {
    return work.costs.at(row_of_group).data() + kCostsInARegister;
  }

  void sum_from_below(int begin, int end, Workspace& work) const {
    const int bottom = std::min(end + kRunUpRows, height_) - 1;
    const auto sums_of = [&](int v) -> PathSums& {
      return v < end ? work.from_below.at(v - begin) : work.run_up.at(v % 2);
    };
    PathSums* before = &work.run_up.at((bottom + 1) % 2);
    before->set_to_zero();
    work.lowest.assign(width_, 0);
    Byte* costs = costs_of(0, work);
    for (int v = bottom; v >= begin; --v) {
      costs_.compute_row(v, costs);
      advance_row(shape_, costs, vertical_steps_[std::min(v + 1, height_ - 1)], before->pixel(0),
                  work.lowest.data(), sums_of(v).pixel(0));
      before = &sums_of(v);
    }
  }

  void begin_from_above(int begin, Workspace& work) const {
    const int top = std::max(begin - kRunUpRows, 0);
    work.from_above.at((top + kGroupRows - 1) % kGroupRows).set_to_zero();
    work.lowest.assign(width_, 0);
    for (int v = top; v < begin; ++v) advance_from_above(v, work);
  }

  /// Computes a row's costs, too; rows take turns with their room.
  void advance_from_above(int v, Workspace& work) const {
    Byte* costs = costs_of(v % kGroupRows, work);
    costs_.compute_row(v, costs);
    advance_row(shape_, costs, vertical_steps_[v],
                work.from_above.at((v + kGroupRows - 1) % kGroupRows).pixel(0), work.lowest.data(),
                work.from_above.at(v % kGroupRows).pixel(0));
  }

  RowGroup group_of(int begin, int v, int num_rows, Workspace& work) const {
    RowGroup group{};
    group.num_rows = num_rows;
    for (int i = 0; i < num_rows; ++i) {
      std::fill_n(work.from_left.at(i).pixel(0), costs_.size(), Byte{0});
      work.from_right.at(i).set_to_zero();
      group.horizontal_steps.at(i) = horizontal_steps_[v + i];
      group.costs.at(i) = costs_of(i, work);
      group.from_left.at(i) = work.from_left.at(i).pixel(0);
      group.from_right.at(i) = work.from_right.at(i).pixel(0);
      group.from_above.at(i) = work.from_above.at(i).pixel(0);
      group.from_below.at(i) = work.from_below.at(v + i - begin).pixel(0);
    }
    return group;
  }

  /// Of each pixel the disparity of lowest cost, if the right image's pixel chose it too.
  void choose(const Byte* costs, Workspace& work, float* disparity_px) const {
    lowest_.find_left(costs, work.left.data());
    lowest_.find_right(costs, work.right_mirrored.data());
    const auto right = [&](int u) { return int{work.right_mirrored[width_ - 1 - u]}; };
    for (int u = 0; u < width_; ++u) {
      const int d = work.left[u];
      const bool is_match =
          d > 1 && d <= u && std::abs(right(u - d) - d) <= params_.max_left_right_difference_px;
      disparity_px[u] = is_match ? static_cast<float>(d) + fraction(costs, u, d) : 0.0F;
    }
  }

  /// Where a parabola through the costs of the disparity and its neighbours is lowest [px].
  float fraction(const Byte* costs, int u, int d) const {
    if (d + 1 >= params_.num_disparities) return 0.0F;
    const Byte* cost = &costs[static_cast<std::size_t>(u) * costs_.size() + d];
    const int less = cost[-1] - *cost, more = cost[1] - *cost;
    return less + more > 0
               ? 0.5F * static_cast<float>(less - more) / static_cast<float>(less + more)
               : 0.0F;
  }

  SemiGlobalParams params_;
  int width_, height_;
  MatchingCosts costs_;
  cv::Mat1b vertical_steps_, horizontal_steps_;  ///< costs of large steps from above, from the left
  PathShape shape_;
  LowestCosts lowest_;
};

}  // namespace

cv::Mat1f match_semi_global(const cv::Mat1b& left, const cv::Mat1b& right,
                            const SemiGlobalParams& params) {
  if (left.size() != right.size())
    throw std::invalid_argument("left and right image differ in size");
  if (params.num_disparities > kMaxDisparities)
    throw std::invalid_argument("more than 255 disparities");
  const StripMatcher matcher(left, right, params);
  cv::Mat1f disparity_px(left.size());
  const int num_strips = (left.rows + kStripRows - 1) / kStripRows;
  cv::parallel_for_(
      cv::Range(0, num_strips),
      [&](const cv::Range& strips) {
        thread_local Workspace workspace;
        for (int i = strips.start; i < strips.end; ++i)
          matcher.match(i * kStripRows, std::min((i + 1) * kStripRows, left.rows), workspace,
                        disparity_px);
      },
      num_strips);
  return disparity_px;
}

}  // namespace limbcast::reconstructor
