#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/cloud/cloud.hpp"

namespace limbcast::lcm_io {

/// How finely messages carry depths and coordinates.
struct QuantizationParams {
  /// Steps in one standard deviation of the sensor's depth noise. 10: rounding adds 0.04 % to the
  /// variance.
  float steps_per_sigma = 10.0F;
  /// Nearest depth that must be representable [m]; closer than any stereo pair sees a person.
  float min_depth_m = 0.2F;
  /// Finest step of a coordinate in a list of points [m]: a tenth of a laser range finder's 10 mm.
  double resolution_m = 0.001;
};

/// S such that z = S / q, q in 1 .. 65535: q counts equal steps of inverse depth, as stereo
/// measures it.
double inverse_depth_scale(const DepthNoise& noise, const QuantizationParams& params = {});

/// Depths [m] (0 = hole) to q (0 = hole). Depths that no q can express become holes.
void quantize_depths(const float* depths_m, std::size_t count, double scale, std::uint16_t* codes);
std::vector<std::uint16_t> quantize_depths(const std::vector<float>& depths_m, double scale);
void dequantize_depths(const std::uint16_t* codes, std::size_t count, double scale,
                       float* depths_m);
std::vector<float> dequantize_depths(const std::vector<std::uint16_t>& codes, double scale);

/// Step [m] with which all coordinates of these points fit 16 bits.
double list_resolution_m(const std::vector<Eigen::Vector3f>& points_m,
                         const QuantizationParams& params = {});
/// x of all points, then y, then z, in steps.
std::vector<std::int16_t> quantize_points(const std::vector<Eigen::Vector3f>& points_m,
                                          double resolution_m);
std::vector<Eigen::Vector3f> dequantize_points(const std::vector<std::int16_t>& codes,
                                               double resolution_m);

/// Step with which all of these values fit 16 bits: 1 where it loses nothing (whole numbers, as
/// most scanners give intensities), else as fine as 16 bits allow.
double value_step(const std::vector<float>& values);
std::vector<std::int16_t> quantize_values(const std::vector<float>& values, double step);
std::vector<float> dequantize_values(const std::vector<std::int16_t>& codes, double step);

}  // namespace limbcast::lcm_io
