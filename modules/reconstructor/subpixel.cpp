#include "modules/reconstructor/subpixel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "common/simd.hpp"

namespace limbcast::reconstructor {
namespace {

/// Sides of the windows in which a surface is one, for its shape and for its shift: smaller follows
/// fine shapes, larger quiets noise. Constants, so that the compiler unrolls the loops over them.
constexpr int kShapeWindowPx = 7, kShiftWindowPx = 9;
/// Nearer to a step both images show what lies on either side of it, in different places: window
/// and blur carry it so far. Shifts found there took arms 2 cm too far at 3 m.
constexpr int kStepMarginPx = 2;
/// First pixels of a window's rows, or of its columns.
template <int window_px>
using Taps = std::array<const float*, window_px>;

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

/// Value and slope between four samples (Catmull and Rom's cubic).
struct Sample {
  float value, slope;
};
Sample interpolate(const float* samples, float fraction) {
  const float before = samples[-1], here = samples[0], next = samples[1], after = samples[2];
  const float linear = 0.5F * (next - before);
  const float square = before - 2.5F * here + 2.0F * next - 0.5F * after;
  const float cube = 0.5F * (after - before) + 1.5F * (here - next);
  return {here + fraction * (linear + fraction * (square + fraction * cube)),
          linear + fraction * (2.0F * square + fraction * 3.0F * cube)};
}

/// What a window's shift is found from: of a row's pixels, or summed over windows.
enum Term { kNumber, kSlope, kDifference, kSlopeSquared, kProduct, kNumTerms };
using Terms = std::array<std::vector<float>, kNumTerms>;

/// 255 where a pixel and all within kStepMarginPx of it are on one surface.
cv::Mat1b inside_surfaces(const cv::Mat1f& disparity_px, float same_surface_px) {
  const cv::Mat1b window = cv::Mat1b::ones(2 * kStepMarginPx + 1, 2 * kStepMarginPx + 1);
  cv::Mat1f lowest, highest;
  cv::erode(disparity_px, lowest, window);
  cv::dilate(disparity_px, highest, window);
  const cv::Mat1b near = highest - disparity_px <= same_surface_px;
  const cv::Mat1b far = disparity_px - lowest <= same_surface_px;
  return near & far;
}

/// The terms of each pixel of a row; 0 where it is not inside a surface or its match has no
/// surroundings.
void compute_terms(const float* left, const float* right, const float* disparity_px,
                   const std::uint8_t* inside, int width, Terms& terms) {
  for (auto& term : terms) term.assign(width, 0.0F);
  for (int u = 1; u + 1 < width; ++u) {
    const float matched = static_cast<float>(u) - disparity_px[u];
    const int column = static_cast<int>(matched);
    if (inside[u] == 0 || disparity_px[u] <= 0.0F || column < 1 || column + 2 >= width) continue;
    const Sample sample = interpolate(right + column, matched - static_cast<float>(column));
    const float slope = 0.5F * (sample.slope + 0.5F * (left[u + 1] - left[u - 1]));
    const float difference = sample.value - left[u];
    terms[kNumber][u] = 1.0F;
    terms[kSlope][u] = slope;
    terms[kDifference][u] = difference;
    terms[kSlopeSquared][u] = slope * slope;
    terms[kProduct][u] = slope * difference;
  }
}

/// By how much a window's disparity is to grow [px].
float shift_px(const Terms& sums, int u, float noise_variance) {
  constexpr float kMaxShiftPx = 0.5F;  // beyond, the step's linear picture of the image fails
  const float number = sums[kNumber][u];
  if (number < 1.0F) return 0.0F;
  const float slope = sums[kSlope][u], difference = sums[kDifference][u];
  const float variance = sums[kSlopeSquared][u] - slope * slope / number;
  const float covariance = sums[kProduct][u] - slope * difference / number;
  return std::clamp(covariance / (variance + noise_variance * number), -kMaxShiftPx, kMaxShiftPx);
}

void shift_windows(const cv::Mat1f& left, const cv::Mat1f& right, const SubpixelParams& params,
                   cv::Mat1f& disparity_px) {
  using Filter = WindowFilter<kShiftWindowPx, decltype(&sum_window)>;
  const int width = left.cols;
  const cv::Mat1b inside_surface = inside_surfaces(disparity_px, params.same_surface_px);
  std::vector<Filter> filters(kNumTerms, {width, sum_window});
  Terms terms, sums;
  for (auto& sum : sums) sum.resize(width);
  for (int v = 0; v < left.rows + Filter::kRadiusPx; ++v) {
    const bool inside = v < left.rows;
    if (inside) compute_terms(left[v], right[v], disparity_px[v], inside_surface[v], width, terms);
    for (int i = 0; i < kNumTerms; ++i) filters[i].push(inside ? terms[i].data() : nullptr);
    if (v < Filter::kRadiusPx) continue;
    for (int i = 0; i < kNumTerms; ++i) filters[i].pull(sums[i].data());
    float* row = disparity_px[v - Filter::kRadiusPx];
    for (int u = 0; u < width; ++u)
      if (row[u] > 0.0F) row[u] += shift_px(sums, u, params.noise_variance);
  }
}

cv::Mat1f blurred(const cv::Mat1b& image, double blur_px) {
  cv::Mat1f result;
  image.convertTo(result, CV_32F);
  cv::GaussianBlur(result, result, {0, 0}, blur_px);
  return result;
}

}  // namespace

void refine_disparities(const cv::Mat1b& left, const cv::Mat1b& right, const SubpixelParams& params,
                        cv::Mat1f& disparity_px) {
  disparity_px = smooth_surfaces(disparity_px, params.same_surface_px);
  shift_windows(blurred(left, params.blur_px), blurred(right, params.blur_px), params,
                disparity_px);
  disparity_px = smooth_surfaces(disparity_px, params.same_surface_px);  // the shifts are noisy too
}

}  // namespace limbcast::reconstructor
