#include "modules/reconstructor/semi_global.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/core/hal/intrin.hpp>
#include <stdexcept>
#include <vector>

#include "modules/reconstructor/census.hpp"
#include "modules/reconstructor/simd.hpp"

// Costs are bytes, and neighbouring pixels stand in neighbouring bytes: of each line of pixels
// first all pixels at disparity 0, then all at 1, ... So every step of the method is a plain loop
// over pixels that the compiler turns into vector instructions, with no work across lanes. A path
// from above goes from row to row; a path from the left does the same on the transposed image.
namespace limbcast::reconstructor {
namespace {

using Byte = std::uint8_t;

/// Rows that are matched together: few, so that their costs stay in the cache.
constexpr int kStripRows = 64;
/// Rows above and below a strip where its vertical paths begin.
constexpr int kRunUpRows = 16;

/// Costs [line][disparity][pixel]; a line is a row of the image, or a column.
class Volume {
 public:
  /// Gives it another shape; what it held is lost.
  void reshape(int num_lines, int num_disparities, int num_pixels) {
    num_pixels_ = static_cast<std::size_t>(num_pixels);
    // Not a power of two, or all lines would meet in the same few sets of the cache.
    line_size_ = num_disparities * num_pixels_ + 64;
    if (bytes_.size() < line_size_ * num_lines) bytes_.resize(line_size_ * num_lines);
  }
  Byte* line(int index) { return &bytes_[line_size_ * index]; }
  Byte* row(int index, int disparity) { return line(index) + num_pixels_ * disparity; }

 private:
  std::size_t num_pixels_ = 0, line_size_ = 0;
  std::vector<Byte> bytes_;
};

/// Room for matching a strip, kept from one to the next: asking the system for it each time takes
/// longer than filling it.
struct Workspace {
  Volume costs, sums, horizontal_sums;
  std::array<std::vector<Byte>, 2> cost_turns, sum_turns;  ///< this line's and the one before's
  void reserve_turns(std::size_t size) {
    for (auto* turns : {&cost_turns, &sum_turns})
      for (auto& turn : *turns) turn.resize(size);
  }
};

using PlaneRows = std::array<const Byte*, Census::kNumPlanes>;

/// Differing bits of two pixels' census, for `count` pixels.
LIMBCAST_SIMD void hamming_distance(const PlaneRows& left, const PlaneRows& right, int count,
                                    Byte* __restrict cost) {
  const Byte* __restrict l0 = left[0];
  const Byte* __restrict l1 = left[1];
  const Byte* __restrict l2 = left[2];
  const Byte* __restrict r0 = right[0];
  const Byte* __restrict r1 = right[1];
  const Byte* __restrict r2 = right[2];
  // Bits are counted in pairs, then in nibbles; these are added over the planes (at most 3 x 4)
  // before the two of a byte are.
  const auto nibbles = [](Byte bits) {
    const auto pairs = static_cast<Byte>(bits - ((bits >> 1) & 0x55));
    return static_cast<Byte>((pairs & 0x33) + ((pairs >> 2) & 0x33));
  };
  for (int i = 0; i < count; ++i) {
    const auto sum =
        static_cast<Byte>(nibbles(l0[i] ^ r0[i]) + nibbles(l1[i] ^ r1[i]) + nibbles(l2[i] ^ r2[i]));
    cost[i] = static_cast<Byte>((sum & 0x0f) + (sum >> 4));
  }
}

/// One step of a path for all pixels of a line, from the line before to this one:
/// L(d) = C(d) + min(L'(d), L'(d - 1) + P1, L'(d + 1) + P1, min L' + P2) - min L'.
/// `lowest` is min L' before and min L after; `jump` is room for one row.
LIMBCAST_SIMD void advance(const Byte* __restrict cost, const Byte* __restrict before,
                           const Byte* __restrict large_step, int num_disparities, int count,
                           Byte small_step, Byte* __restrict lowest, Byte* __restrict jump,
                           Byte* __restrict now) {
  Byte* __restrict low_now = jump + count;
  for (int i = 0; i < count; ++i) {
    jump[i] = static_cast<Byte>(lowest[i] + large_step[i]);
    low_now[i] = 255;
  }
  for (int d = 0; d < num_disparities; ++d) {
    const Byte* same = before + d * count;
    const Byte* less = d > 0 ? same - count : jump;
    const Byte* more = d + 1 < num_disparities ? same + count : jump;
    const Byte* c = cost + d * count;
    Byte* out = now + d * count;
    for (int i = 0; i < count; ++i) {
      const auto stepped = static_cast<Byte>(std::min(less[i], more[i]) + small_step);
      const Byte best = std::min(std::min(same[i], jump[i]), stepped);
      const auto sum = static_cast<Byte>(c[i] + static_cast<Byte>(best - lowest[i]));
      out[i] = sum;
      low_now[i] = std::min(low_now[i], sum);
    }
  }
  for (int i = 0; i < count; ++i) lowest[i] = low_now[i];
}

LIMBCAST_SIMD void add(const Byte* __restrict summand, std::size_t count, Byte* __restrict sum) {
  for (std::size_t i = 0; i < count; ++i) sum[i] = static_cast<Byte>(sum[i] + summand[i]);
}

LIMBCAST_SIMD void average(const Byte* __restrict a, const Byte* __restrict b, std::size_t count,
                           Byte* __restrict result) {
  for (std::size_t i = 0; i < count; ++i) result[i] = static_cast<Byte>((a[i] + b[i] + 1) >> 1);
}

/// Takes disparity `d` where its cost is lower than the lowest so far.
LIMBCAST_SIMD void keep_lower(const Byte* __restrict cost, Byte d, int count,
                              Byte* __restrict lowest, Byte* __restrict disparity) {
  for (int i = 0; i < count; ++i) {
    const Byte now = cost[i], before = lowest[i];
    const auto is_lower = static_cast<Byte>(now < before ? 0xff : 0);  // a mask, no branch
    disparity[i] = static_cast<Byte>((d & is_lower) | (disparity[i] & ~is_lower));
    lowest[i] = std::min(now, before);
  }
}

/// A path on its way from line to line.
class Path {
 public:
  Path(int num_disparities, int count, Byte small_step)
      : num_disparities_(num_disparities),
        count_(count),
        small_step_(small_step),
        lowest_(count),
        scratch_(2UL * count) {}
  /// Sums along the path at the next line: `cost` itself where the path begins.
  void advance(const Byte* cost, const Byte* large_step, Byte* sums) {
    if (before_ == nullptr) {
      std::copy_n(cost, static_cast<std::size_t>(num_disparities_) * count_, sums);
      std::fill(lowest_.begin(), lowest_.end(), Byte{255});
      for (int d = 0; d < num_disparities_; ++d)
        for (int i = 0; i < count_; ++i)
          lowest_[i] = std::min(lowest_[i], sums[static_cast<std::size_t>(d) * count_ + i]);
    } else {
      reconstructor::advance(cost, before_, large_step, num_disparities_, count_, small_step_,
                             lowest_.data(), scratch_.data(), sums);
    }
    before_ = sums;
  }

 private:
  int num_disparities_, count_;
  Byte small_step_;
  const Byte* before_ = nullptr;
  std::vector<Byte> lowest_, scratch_;
};

/// What the paths along one axis need of the images.
struct Axis {
  Census left, right;
  cv::Mat1b large_step;  ///< cost of a large step from the line before
};

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

PlaneRows rows_of(const Census& census, int line, int first) {
  PlaneRows rows{};
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = census.planes[i][line] + first;
  return rows;
}

/// Transposes the plane of one disparity: pixel p of line l becomes pixel l of line p.
void transpose(Volume& from, int num_lines, int num_pixels, int disparity, Volume& to) {
  constexpr int kBlock = cv::v_uint8x16::nlanes;
  const auto one_by_one = [&](int line_begin, int line_end, int pixel_begin, int pixel_end) {
    for (int l = line_begin; l < line_end; ++l)
      for (int p = pixel_begin; p < pixel_end; ++p)
        to.row(p, disparity)[l] = from.row(l, disparity)[p];
  };
  const int whole_lines = num_lines / kBlock * kBlock, whole_pixels = num_pixels / kBlock * kBlock;
  for (int l = 0; l < whole_lines; l += kBlock) {
    for (int p = 0; p < whole_pixels; p += kBlock) {
      std::array<cv::v_uint8x16, kBlock> block, shuffled;
      for (int i = 0; i < kBlock; ++i) block[i] = cv::v_load(from.row(l + i, disparity) + p);
      // A perfect shuffle of the block's bytes moves one bit of the line's number to the pixel's.
      for (int bit = 1; bit < kBlock; bit *= 2) {
        for (int i = 0; i < kBlock / 2; ++i)
          cv::v_zip(block[i], block[i + kBlock / 2], shuffled[2 * i], shuffled[2 * i + 1]);
        std::swap(block, shuffled);
      }
      for (int i = 0; i < kBlock; ++i) cv::v_store(to.row(p + i, disparity) + l, block[i]);
    }
  }
  one_by_one(0, whole_lines, whole_pixels, num_pixels);
  one_by_one(whole_lines, num_lines, 0, num_pixels);
}

/// Matches strips of rows, each by itself.
class StripMatcher {
 public:
  StripMatcher(const cv::Mat1b& left, const cv::Mat1b& right, const SemiGlobalParams& params)
      : params_(params), width_(left.cols), height_(left.rows) {
    rows_ = {census_of(left), census_of(right), large_step_costs(left, params)};
    for (cv::Mat1b& plane : rows_.right.planes)
      cv::copyMakeBorder(plane, plane, 0, 0, params.num_disparities, 0, cv::BORDER_REPLICATE);
    columns_.large_step = large_step_costs(left.t(), params);
    const Census right_census = census_of(right);
    for (int i = 0; i < Census::kNumPlanes; ++i) {
      cv::transpose(rows_.left.planes[i], columns_.left.planes[i]);
      cv::transpose(right_census.planes[i], columns_.right.planes[i]);
    }
  }

  void match(int begin, int end, Workspace& work, cv::Mat1f& disparity_px) const {
    sum_horizontal_paths(begin, end, work);
    sum_vertical_paths(begin, end, work);
    std::vector<Byte>& costs = work.cost_turns[0];
    for (int v = begin; v < end; ++v) {
      average(work.horizontal_sums.line(v - begin), work.sums.line(v - begin), costs.size(),
              costs.data());
      choose(costs, disparity_px[v]);
    }
  }

 private:
  std::size_t line_size(int count) const {
    return static_cast<std::size_t>(params_.num_disparities) * count;
  }
  Path path(int count) const {
    return {params_.num_disparities, count, static_cast<Byte>(params_.small_step_cost)};
  }

  void match_column(int u, int begin, int count, Byte* cost) const {
    for (int d = 0; d < params_.num_disparities; ++d)
      hamming_distance(rows_of(columns_.left, u, begin),
                       rows_of(columns_.right, std::max(u - d, 0), begin), count,
                       cost + static_cast<std::size_t>(d) * count);
  }
  void match_row(int v, Byte* cost) const {
    for (int d = 0; d < params_.num_disparities; ++d)
      hamming_distance(rows_of(rows_.left, v, 0),
                       rows_of(rows_.right, v, params_.num_disparities - d), width_,
                       cost + static_cast<std::size_t>(d) * width_);
  }

  void sum_horizontal_paths(int begin, int end, Workspace& work) const {
    const int num_disparities = params_.num_disparities, count = end - begin;
    work.costs.reshape(width_, num_disparities, count);
    work.sums.reshape(width_, num_disparities, count);
    work.reserve_turns(line_size(count));
    Path from_left = path(count);
    for (int u = 0; u < width_; ++u) {
      match_column(u, begin, count, work.costs.line(u));
      from_left.advance(work.costs.line(u), columns_.large_step[u] + begin, work.sums.line(u));
    }
    Path from_right = path(count);
    for (int u = width_ - 1; u >= 0; --u) {
      Byte* now = work.sum_turns.at(u % 2).data();
      const int before = std::min(u + 1, width_ - 1);
      from_right.advance(work.costs.line(u), columns_.large_step[before] + begin, now);
      add(now, line_size(count), work.sums.line(u));
    }
    work.horizontal_sums.reshape(count, num_disparities, width_);
    for (int d = 0; d < num_disparities; ++d)
      transpose(work.sums, width_, count, d, work.horizontal_sums);
  }

  void sum_vertical_paths(int begin, int end, Workspace& work) const {
    work.costs.reshape(end - begin, params_.num_disparities, width_);
    work.sums.reshape(end - begin, params_.num_disparities, width_);
    work.reserve_turns(line_size(width_));
    const auto is_inside = [&](int v) { return v >= begin && v < end; };
    const auto cost_of = [&](int v) {
      return is_inside(v) ? work.costs.line(v - begin) : work.cost_turns.at(v % 2).data();
    };
    Path from_below = path(width_);
    for (int v = std::min(end + kRunUpRows, height_) - 1; v >= begin; --v) {
      match_row(v, cost_of(v));
      Byte* now = is_inside(v) ? work.sums.line(v - begin) : work.sum_turns.at(v % 2).data();
      from_below.advance(cost_of(v), rows_.large_step[std::min(v + 1, height_ - 1)], now);
    }
    Path from_above = path(width_);
    for (int v = std::max(begin - kRunUpRows, 0); v < end; ++v) {
      if (!is_inside(v)) match_row(v, cost_of(v));
      Byte* now = work.sum_turns.at(v % 2).data();
      from_above.advance(cost_of(v), rows_.large_step[v], now);
      if (is_inside(v)) add(now, line_size(width_), work.sums.line(v - begin));
    }
  }

  /// Of each pixel the disparity of lowest cost, if the right image's pixel chose it too.
  void choose(const std::vector<Byte>& costs, float* disparity_px) const {
    std::vector<Byte> left(width_), right(width_), lowest_left(width_, 255),
        lowest_right(width_, 255);
    for (int d = 0; d < params_.num_disparities; ++d) {
      const Byte* cost = &costs[static_cast<std::size_t>(d) * width_];
      keep_lower(cost, static_cast<Byte>(d), width_, lowest_left.data(), left.data());
      // The right image's pixel u - d sees what the left's pixel u sees at disparity d.
      keep_lower(cost + d, static_cast<Byte>(d), width_ - d, lowest_right.data(), right.data());
    }
    for (int u = 0; u < width_; ++u) {
      const int d = left[u];
      const bool is_match =
          d > 1 && d <= u && std::abs(right[u - d] - d) <= params_.max_left_right_difference_px;
      disparity_px[u] = is_match ? static_cast<float>(d) + fraction(costs, u, d) : 0.0F;
    }
  }

  /// Where a parabola through the costs of the disparity and its neighbours is lowest [px].
  float fraction(const std::vector<Byte>& costs, int u, int d) const {
    if (d + 1 >= params_.num_disparities) return 0.0F;
    const Byte* cost = &costs[static_cast<std::size_t>(d) * width_ + u];
    const int less = cost[-width_] - *cost, more = cost[width_] - *cost;
    return less + more > 0
               ? 0.5F * static_cast<float>(less - more) / static_cast<float>(less + more)
               : 0.0F;
  }

  SemiGlobalParams params_;
  int width_, height_;
  Axis rows_, columns_;
};

}  // namespace

cv::Mat1f match_semi_global(const cv::Mat1b& left, const cv::Mat1b& right,
                            const SemiGlobalParams& params) {
  if (left.size() != right.size())
    throw std::invalid_argument("left and right image differ in size");
  if (params.num_disparities > kMaxDisparities)
    throw std::invalid_argument(
        "more than 255 disparities: raise near-limit-m or lower image-scale");
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
