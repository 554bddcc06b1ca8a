#pragma once

#include <opencv2/core/mat.hpp>

#include "modules/simulate/scenario.hpp"

namespace limbcast::simulate {

/// What a pinhole camera at `offset_m` from the sensor's origin meets; all it renders comes from
/// this.
HitImage look(const World& world, const PinholeCamera& camera,
              const Eigen::Vector3f& offset_m = Eigen::Vector3f::Zero());

/// Distance along the optical axis [m], 32-bit float, 0 = nothing.
cv::Mat depth_image(const HitImage& hits, const PinholeCamera& camera);
/// Index of the person at each pixel, 8 bit, 0 = none.
cv::Mat person_mask(const World& world, const HitImage& hits);
/// Body part at each pixel, 8 bit, values of Part.
cv::Mat part_labels(const World& world, const HitImage& hits);
/// Cosine between ray and surface at each pixel, 32-bit float, 0 = nothing: grazing surfaces
/// measure badly.
cv::Mat facing_image(const World& world, const HitImage& hits, const PinholeCamera& camera,
                     const Eigen::Vector3f& offset_m = Eigen::Vector3f::Zero());

struct ShadingParams {
  double ambient = 0.55;    ///< share of the light that comes from everywhere
  double blur_px = 0.55;    ///< sigma of lens and pixel
  double noise_grey = 2.0;  ///< sigma of the sensor's noise, of 255
};

/// 8-bit BGR picture of what `hits` met: Lambert's shading and solid textures. `noise` only adds
/// noise.
cv::Mat color_image(const Scenario& scenario, const HitImage& hits, const PinholeCamera& camera,
                    Rng noise, const ShadingParams& params = {},
                    const Eigen::Vector3f& offset_m = Eigen::Vector3f::Zero());

}  // namespace limbcast::simulate
