#include "modules/reconstructor/subpixel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core/fast_math.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "common/simd.hpp"
#include "modules/reconstructor/window_filter.hpp"

namespace limbcast::reconstructor {
namespace {

/// Sides of the windows in which a surface is one, for its shape and for its shift: smaller follows
/// fine shapes, larger quiets noise. Constants, so that the compiler unrolls the loops over them.
constexpr int kShapeWindowPx = 7, kShiftWindowPx = 9;
/// Nearer to a step both images show what lies on either side of it, in different places: window
/// and blur carry it so far. Shifts found there took arms 2 cm too far at 3 m.
constexpr int kStepMarginPx = 2;
LIMBCAST_SIMD void sum_window(const Taps<kShiftWindowPx>& taps, int count, float* __restrict sums) {
  for (int i = 0; i < count; ++i) {
    float sum = 0.0F;
    for (const float* tap : taps) sum += tap[i];
    sums[i] = sum;
  }
}

/// Mean of those pixels of a window that are on the surface of its middle, the more alike the more
/// weight; a hole (0) stays one.
LIMBCAST_SIMD void average_surface(const Taps<kShapeWindowPx>& taps, float same_surface_px,
                                   int count, float* __restrict means) {
  for (int i = 0; i < count; ++i) {
    const float middle = taps[kShapeWindowPx / 2][i];
    float sum = 0.0F, weights = 0.0F;
    for (const float* tap : taps) {
      const float alike = same_surface_px - std::abs(tap[i] - middle);
      const float weight = alike + std::abs(alike);  // 0 where not alike, without a branch
      sum += weight * tap[i];
      weights += weight;
    }
    means[i] = sum / weights;
  }
}

cv::Mat1f smooth_surfaces(const cv::Mat1f& disparity_px, float same_surface_px) {
  const auto average = [=](const Taps<kShapeWindowPx>& taps, int count, float* means) {
    average_surface(taps, same_surface_px, count, means);
  };
  using Filter = WindowFilter<kShapeWindowPx, decltype(average)>;
  Filter filter(disparity_px.cols, average);
  cv::Mat1f smoothed(disparity_px.size());
  for (int v = 0; v < disparity_px.rows + Filter::kRadiusPx; ++v) {
    filter.push(v < disparity_px.rows ? disparity_px[v] : nullptr);
    if (v >= Filter::kRadiusPx) filter.pull(smoothed[v - Filter::kRadiusPx]);
  }
  return smoothed;
}

/// Rows of a margin's window, and its sides.
constexpr int kMarginWindowPx = 2 * kStepMarginPx + 1;

LIMBCAST_SIMD void find_range(const Taps<kMarginWindowPx>& taps, int count,
                              float* __restrict lowest, float* __restrict highest) {
  for (int i = 0; i < count; ++i) {
    float low = taps[0][i], high = taps[0][i];
    for (int tap = 1; tap < kMarginWindowPx; ++tap) {
      low = std::min(low, taps[tap][i]);
      high = std::max(high, taps[tap][i]);
    }
    lowest[i] = low;
    highest[i] = high;
  }
}

LIMBCAST_SIMD void mark_inside(const Taps<kMarginWindowPx>& lowest,
                               const Taps<kMarginWindowPx>& highest, const float* disparity_px,
                               float same_surface_px, int count, std::uint8_t* __restrict inside) {
  for (int i = 0; i < count; ++i) {
    float low = lowest[0][i], high = highest[0][i];
    for (int tap = 1; tap < kMarginWindowPx; ++tap) {
      low = std::min(low, lowest[tap][i]);
      high = std::max(high, highest[tap][i]);
    }
    const bool near = high - disparity_px[i] <= same_surface_px;
    const bool far = disparity_px[i] - low <= same_surface_px;
    inside[i] = near && far ? 1 : 0;
  }
}

/// Tells of a row's pixels whether all within kStepMarginPx are on one surface.
class MarginFilter {
 public:
  explicit MarginFilter(int width)
      : lowest_(width + 2 * kStepMarginPx), highest_(lowest_.size()), inside_(width) {}

  const std::uint8_t* operator()(const cv::Mat1f& disparity_px, int v, float same_surface_px) {
    const int width = disparity_px.cols;
    Taps<kMarginWindowPx> rows{}, lowest{}, highest{};
    for (int i = 0; i < kMarginWindowPx; ++i) {
      rows[i] = disparity_px[std::clamp(v + i - kStepMarginPx, 0, disparity_px.rows - 1)];
      lowest[i] = lowest_.data() + i;
      highest[i] = highest_.data() + i;
    }
    find_range(rows, width, lowest_.data() + kStepMarginPx, highest_.data() + kStepMarginPx);
    for (auto* range : {&lowest_, &highest_}) {
      std::fill_n(range->begin(), kStepMarginPx, (*range)[kStepMarginPx]);
      std::fill_n(range->rbegin(), kStepMarginPx, (*range)[kStepMarginPx + width - 1]);
    }
    mark_inside(lowest, highest, disparity_px[v], same_surface_px, width, inside_.data());
    return inside_.data();
  }

 private:
  std::vector<float> lowest_, highest_;  ///< of each column; the border's repeated beyond it
  std::vector<std::uint8_t> inside_;
};

/// What a window's shift is found from: of a row's pixels, or summed over windows.
enum Term { kNumber, kSlope, kDifference, kSlopeSquared, kProduct, kNumTerms };
using Terms = std::array<std::vector<float>, kNumTerms>;

/// Where a row's pixels are matched, and the right image there.
struct Matches {
  explicit Matches(int width) : columns(width), fractions(width) {
    for (auto& sample : samples) sample.resize(width);
  }
  std::vector<std::int32_t> columns;          ///< left of the match
  std::vector<float> fractions;               ///< of a pixel, from there to the match
  std::array<std::vector<float>, 4> samples;  ///< from one column before to two after
};

/// `is_sound` is 1 where a pixel is inside a surface and its match has surroundings, else 0.
/// Choices are products here and below: where they branch the compiler vectorises nothing.
LIMBCAST_SIMD void find_matches(const float* __restrict disparity_px,
                                const std::uint8_t* __restrict inside, int width,
                                std::int32_t* __restrict columns, float* __restrict fractions,
                                float* __restrict is_sound) {
  for (int u = 0; u < width; ++u) {
    const float matched = static_cast<float>(u) - disparity_px[u];
    const auto column = static_cast<std::int32_t>(matched);
    const int sound = static_cast<int>(inside[u]) & static_cast<int>(disparity_px[u] > 0.0F) &
                      static_cast<int>(column >= 1) & static_cast<int>(column < width - 2);
    columns[u] = 1 + sound * (column - 1);
    fractions[u] = matched - static_cast<float>(column);
    is_sound[u] = static_cast<float>(sound);
  }
}

void read_samples(const float* right, int width, Matches& matches) {
  auto& [before, here, next, after] = matches.samples;
  for (int u = 0; u < width; ++u) {
    const float* sample = right + matches.columns[u];
    before[u] = sample[-1];
    here[u] = sample[0];
    next[u] = sample[1];
    after[u] = sample[2];
  }
}

/// Value and slope between four samples (Catmull and Rom's cubic).
LIMBCAST_SIMD void interpolate(const float* __restrict befores, const float* __restrict heres,
                               const float* __restrict nexts, const float* __restrict afters,
                               const float* __restrict fractions, int count,
                               float* __restrict values, float* __restrict slopes) {
  for (int i = 0; i < count; ++i) {
    const float before = befores[i], here = heres[i], next = nexts[i], after = afters[i];
    const float linear = 0.5F * (next - before);
    const float square = before - 2.5F * here + 2.0F * next - 0.5F * after;
    const float cube = 0.5F * (after - before) + 1.5F * (here - next);
    const float fraction = fractions[i];
    values[i] = here + fraction * (linear + fraction * (square + fraction * cube));
    slopes[i] = linear + fraction * (2.0F * square + fraction * 3.0F * cube);
  }
}

/// Slopes and values of the right image to terms of the pixels from 1 to end; 0 where a match is
/// not sound.
LIMBCAST_SIMD void finish_terms(const float* __restrict is_sound, const float* __restrict left,
                                int end, float* __restrict slopes, float* __restrict values,
                                float* __restrict slopes_squared, float* __restrict products) {
  for (int u = 1; u < end; ++u) {
    const float slope = 0.5F * (slopes[u] + 0.5F * (left[u + 1] - left[u - 1]));
    const float difference = values[u] - left[u];
    slopes[u] = is_sound[u] * slope;
    values[u] = is_sound[u] * difference;
    slopes_squared[u] = is_sound[u] * (slope * slope);
    products[u] = is_sound[u] * (slope * difference);
  }
}

/// The terms of each pixel of a row; those at the image's sides are 0.
void compute_terms(const float* left, const float* right, const float* disparity_px,
                   const std::uint8_t* inside, int width, Matches& matches, Terms& terms) {
  find_matches(disparity_px, inside, width, matches.columns.data(), matches.fractions.data(),
               terms[kNumber].data());
  read_samples(right, width, matches);
  const auto& [before, here, next, after] = matches.samples;
  interpolate(before.data(), here.data(), next.data(), after.data(), matches.fractions.data(),
              width, terms[kDifference].data(), terms[kSlope].data());
  finish_terms(terms[kNumber].data(), left, width - 1, terms[kSlope].data(),
               terms[kDifference].data(), terms[kSlopeSquared].data(), terms[kProduct].data());
  for (auto& term : terms) term.front() = term.back() = 0.0F;
}

/// Lets the disparities of a row grow by what fits best in their windows.
LIMBCAST_SIMD void add_shifts(const std::array<const float*, kNumTerms>& sums, float noise_variance,
                              int count, float* __restrict disparity_px) {
  constexpr float kMaxShiftPx = 0.5F;  // beyond, the step's linear picture of the image fails
  for (int u = 0; u < count; ++u) {
    const float number = std::max(sums[kNumber][u], 1.0F);  // none: all sums are 0
    const float slope = sums[kSlope][u], difference = sums[kDifference][u];
    const float variance = sums[kSlopeSquared][u] - slope * slope / number;
    const float covariance = sums[kProduct][u] - slope * difference / number;
    const float shift = covariance / (variance + noise_variance * number);
    const float limited = std::max(std::min(shift, kMaxShiftPx), -kMaxShiftPx);
    disparity_px[u] += disparity_px[u] > 0.0F ? limited : 0.0F;
  }
}

void shift_windows(const cv::Mat1f& left, const cv::Mat1f& right, const SubpixelParams& params,
                   cv::Mat1f& disparity_px) {
  using Filter = WindowFilter<kShiftWindowPx, decltype(&sum_window)>;
  const int width = left.cols;
  if (width < 4) return;  // four samples are interpolated
  MarginFilter inside_surfaces(width);
  std::vector<Filter> filters(kNumTerms, {width, sum_window});
  Matches matches(width);
  Terms terms, sums;
  for (auto& term : terms) term.assign(width, 0.0F);
  std::array<const float*, kNumTerms> sum_rows{};
  for (int i = 0; i < kNumTerms; ++i) {
    sums[i].resize(width);
    sum_rows[i] = sums[i].data();
  }
  for (int v = 0; v < left.rows + Filter::kRadiusPx; ++v) {
    const bool inside = v < left.rows;
    if (inside)
      compute_terms(left[v], right[v], disparity_px[v],
                    inside_surfaces(disparity_px, v, params.same_surface_px), width, matches,
                    terms);
    for (int i = 0; i < kNumTerms; ++i) filters[i].push(inside ? terms[i].data() : nullptr);
    if (v < Filter::kRadiusPx) continue;
    for (int i = 0; i < kNumTerms; ++i) filters[i].pull(sums[i].data());
    add_shifts(sum_rows, params.noise_variance, width, disparity_px[v - Filter::kRadiusPx]);
  }
}

cv::Mat1f blurred(const cv::Mat1b& image, double gain, double blur_px) {
  cv::Mat1f result;
  image.convertTo(result, CV_32F, gain);
  cv::GaussianBlur(result, result, {0, 0}, blur_px);
  return result;
}

/// How much brighter the left image shows the same surfaces than the right one; 1 where the two
/// agree but for `most_alike`.
double brightness_ratio(const cv::Mat1b& left, const cv::Mat1b& right,
                        const cv::Mat1f& disparity_px, double most_alike) {
  constexpr int kRowStep = 4;
  double in_left = 0.0, in_right = 0.0;
  for (int v = 0; v < left.rows; v += kRowStep) {
    for (int u = 0; u < left.cols; ++u) {
      const int matched = u - cvRound(disparity_px(v, u));
      if (disparity_px(v, u) <= 0.0F || matched < 0) continue;
      in_left += left(v, u);
      in_right += right(v, matched);
    }
  }
  if (in_left <= 0.0 || in_right <= 0.0) return 1.0;
  const double ratio = in_left / in_right;
  return std::abs(ratio - 1.0) <= most_alike ? 1.0 : ratio;
}

}  // namespace

void refine_disparities(const cv::Mat1b& left, const cv::Mat1b& right, const SubpixelParams& params,
                        cv::Mat1f& disparity_px) {
  disparity_px = smooth_surfaces(disparity_px, params.same_surface_px);
  const double gain =
      brightness_ratio(left, right, disparity_px, params.most_brightness_difference);
  shift_windows(blurred(left, 1.0, params.blur_px), blurred(right, gain, params.blur_px), params,
                disparity_px);
  disparity_px = smooth_surfaces(disparity_px, params.same_surface_px);  // the shifts are noisy too
}

}  // namespace limbcast::reconstructor
