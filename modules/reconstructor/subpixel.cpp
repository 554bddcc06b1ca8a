#include "modules/reconstructor/subpixel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "modules/reconstructor/simd.hpp"

namespace limbcast::reconstructor {
namespace {

/// Adds those neighbours that are on the pixel's surface, and counts them.
LIMBCAST_SIMD void add_same_surface(const float* __restrict center,
                                    const float* __restrict neighbour, float same_surface_px,
                                    int count, float* __restrict sum, float* __restrict number) {
  for (int i = 0; i < count; ++i) {
    const float is_same = std::abs(neighbour[i] - center[i]) < same_surface_px ? 1.0F : 0.0F;
    sum[i] += is_same * neighbour[i];
    number[i] += is_same;
  }
}

/// Mean of each pixel's surface along a row or a column of `window_px`. Disparities start above
/// `same_surface_px`, so that no hole (0) is on any surface.
cv::Mat1f smooth_along(const cv::Mat1f& disparity_px, cv::Size window, float same_surface_px) {
  cv::Mat1f padded, sum(disparity_px.size(), 0.0F), number(disparity_px.size(), 0.0F);
  const int above = window.height / 2, beside = window.width / 2;
  cv::copyMakeBorder(disparity_px, padded, above, above, beside, beside, cv::BORDER_CONSTANT, 0.0);
  for (int v = 0; v < disparity_px.rows; ++v)
    for (int y = 0; y < window.height; ++y)
      for (int x = 0; x < window.width; ++x)
        add_same_surface(disparity_px[v], padded[v + y] + x, same_surface_px, disparity_px.cols,
                         sum[v], number[v]);
  return sum / number;
}

/// The same in a square window, rows first.
cv::Mat1f smooth_surfaces(const cv::Mat1f& disparity_px, const SubpixelParams& params) {
  const cv::Mat1f smooth =
      smooth_along(disparity_px, {params.window_px, 1}, params.same_surface_px);
  return smooth_along(smooth, {1, params.window_px}, params.same_surface_px);
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

/// Sums over windows of what the shift is found from.
class Windows {
 public:
  Windows(const cv::Mat1f& left, const cv::Mat1f& right, const cv::Mat1f& disparity_px,
          int window_px) {
    for (cv::Mat1f& sum : sums_) sum = cv::Mat1f(left.size(), 0.0F);
    for (int v = 0; v < left.rows; ++v)
      for (int u = 1; u + 1 < left.cols; ++u)
        if (disparity_px(v, u) > 0.0F)
          add(left, right, v, u, static_cast<float>(u) - disparity_px(v, u));
    for (cv::Mat1f& sum : sums_)
      cv::boxFilter(sum, sum, -1, {window_px, window_px}, {-1, -1}, false, cv::BORDER_CONSTANT);
  }
  /// By how much the disparity is to grow [px].
  float shift_px(int v, int u, float noise_variance) const {
    const float number = sums_[kNumber](v, u);
    if (number < 1.0F) return 0.0F;
    const float slope = sums_[kSlope](v, u), difference = sums_[kDifference](v, u);
    const float variance = sums_[kSlopeSquared](v, u) - slope * slope / number;
    const float covariance = sums_[kProduct](v, u) - slope * difference / number;
    return covariance / (variance + noise_variance * number);
  }

 private:
  enum Sum { kNumber, kSlope, kDifference, kSlopeSquared, kProduct, kNumSums };
  void add(const cv::Mat1f& left, const cv::Mat1f& right, int v, int u, float matched) {
    const int column = static_cast<int>(matched);
    if (column < 1 || column + 2 >= right.cols) return;
    const Sample sample = interpolate(right[v] + column, matched - static_cast<float>(column));
    const float slope = 0.5F * (sample.slope + 0.5F * (left(v, u + 1) - left(v, u - 1)));
    const float difference = sample.value - left(v, u);
    sums_[kNumber](v, u) = 1.0F;
    sums_[kSlope](v, u) = slope;
    sums_[kDifference](v, u) = difference;
    sums_[kSlopeSquared](v, u) = slope * slope;
    sums_[kProduct](v, u) = slope * difference;
  }
  std::array<cv::Mat1f, kNumSums> sums_;
};

cv::Mat1f blurred(const cv::Mat1b& image, double blur_px) {
  cv::Mat1f result;
  image.convertTo(result, CV_32F);
  cv::GaussianBlur(result, result, {0, 0}, blur_px);
  return result;
}

}  // namespace

void refine_disparities(const cv::Mat1b& left, const cv::Mat1b& right, const SubpixelParams& params,
                        cv::Mat1f& disparity_px) {
  constexpr float kMaxShiftPx = 0.5F;  // beyond, the step's linear picture of the image fails
  disparity_px = smooth_surfaces(disparity_px, params);
  const Windows windows(blurred(left, params.blur_px), blurred(right, params.blur_px), disparity_px,
                        params.window_px);
  for (int v = 0; v < disparity_px.rows; ++v)
    for (int u = 0; u < disparity_px.cols; ++u)
      if (disparity_px(v, u) > 0.0F)
        disparity_px(v, u) +=
            std::clamp(windows.shift_px(v, u, params.noise_variance), -kMaxShiftPx, kMaxShiftPx);
  disparity_px = smooth_surfaces(disparity_px, params);  // the shifts are noisy too
}

}  // namespace limbcast::reconstructor
