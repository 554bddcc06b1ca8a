#include "common/lcm_io/quantization.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/simd.hpp"

namespace limbcast::lcm_io {
namespace {

constexpr double kMaxDepthCode = std::numeric_limits<std::uint16_t>::max();
constexpr double kMaxListCode = std::numeric_limits<std::int16_t>::max();

std::int16_t list_code(float value, double step) {
  return static_cast<std::int16_t>(
      std::clamp(std::round(value / step), -kMaxListCode, kMaxListCode));
}

}  // namespace

double inverse_depth_scale(const DepthNoise& noise, const QuantizationParams& params) {
  const double largest = kMaxDepthCode * params.min_depth_m;
  // A step of q is z^2 / S wide, so S = steps / quadratic makes it sigma / steps at every depth.
  if (!noise.grows_with_distance()) return largest;
  return std::min(largest, static_cast<double>(params.steps_per_sigma) / noise.quadratic_per_m);
}

// Without branches, and rounding by hand (halves up; std::round() is a call for each), so that the
// compiler vectorises it.
LIMBCAST_SIMD void quantize_depths(const float* __restrict depths_m, std::size_t count,
                                   double scale, std::uint16_t* __restrict codes) {
  for (std::size_t i = 0; i < count; ++i) {
    const double steps = scale / depths_m[i];
    const double within = steps > 0.0 && steps < kMaxDepthCode + 0.5 ? steps : 0.0;
    const auto whole = static_cast<std::int32_t>(within);
    const auto rest_in_halves = static_cast<std::int32_t>(2.0 * (within - whole));
    codes[i] = static_cast<std::uint16_t>(whole + rest_in_halves);
  }
}

std::vector<std::uint16_t> quantize_depths(const std::vector<float>& depths_m, double scale) {
  std::vector<std::uint16_t> codes(depths_m.size());
  quantize_depths(depths_m.data(), depths_m.size(), scale, codes.data());
  return codes;
}

LIMBCAST_SIMD void dequantize_depths(const std::uint16_t* __restrict codes, std::size_t count,
                                     double scale, float* __restrict depths_m) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto depth_m = static_cast<float>(scale / codes[i]);
    depths_m[i] = codes[i] > 0 ? depth_m : 0.0F;
  }
}

std::vector<float> dequantize_depths(const std::vector<std::uint16_t>& codes, double scale) {
  std::vector<float> depths_m(codes.size());
  dequantize_depths(codes.data(), codes.size(), scale, depths_m.data());
  return depths_m;
}

double list_resolution_m(const std::vector<Eigen::Vector3f>& points_m,
                         const QuantizationParams& params) {
  float largest_m = 0.0F;
  for (const Eigen::Vector3f& point_m : points_m)
    largest_m = std::max(largest_m, point_m.cwiseAbs().maxCoeff());
  return std::max(params.resolution_m, largest_m / kMaxListCode);
}

std::vector<std::int16_t> quantize_points(const std::vector<Eigen::Vector3f>& points_m,
                                          double resolution_m) {
  std::vector<std::int16_t> codes;
  codes.reserve(points_m.size() * 3);
  for (int axis = 0; axis < 3; ++axis)
    for (const Eigen::Vector3f& point_m : points_m)
      codes.push_back(list_code(point_m[axis], resolution_m));
  return codes;
}

std::vector<Eigen::Vector3f> dequantize_points(const std::vector<std::int16_t>& codes,
                                               double resolution_m) {
  const std::size_t count = codes.size() / 3;
  std::vector<Eigen::Vector3f> points_m(count);
  for (std::size_t i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis)
      points_m[i][axis] = static_cast<float>(codes[axis * count + i] * resolution_m);
  return points_m;
}

double value_step(const std::vector<float>& values) {
  double largest = 0.0;
  bool all_whole = true;
  for (const float value : values) {
    largest = std::max(largest, std::abs(static_cast<double>(value)));
    all_whole = all_whole && std::round(value) == value;
  }
  if (all_whole && largest <= kMaxListCode) return 1.0;
  return largest / kMaxListCode;
}

std::vector<std::int16_t> quantize_values(const std::vector<float>& values, double step) {
  std::vector<std::int16_t> codes;
  codes.reserve(values.size());
  for (const float value : values) codes.push_back(list_code(value, step));
  return codes;
}

std::vector<float> dequantize_values(const std::vector<std::int16_t>& codes, double step) {
  std::vector<float> values;
  values.reserve(codes.size());
  for (const std::int16_t code : codes) values.push_back(static_cast<float>(code * step));
  return values;
}

}  // namespace limbcast::lcm_io
