#pragma once

#include <Eigen/Core>
#include <cmath>

#include "common/camera/pinhole_camera.hpp"

namespace limbcast::lcm_io {

/// Bounds that every sensor of a robot keeps. Numbers beyond them are finite too, but overflow
/// where pixels, cells or squares of distances are made of them.
inline constexpr float kFarthest_m = 10'000.0F;
inline constexpr double kShortestFocal_px = 1.0, kLongestFocal_px = 1e6;

inline bool is_plausible(const Eigen::Vector3f& place_m) {
  return place_m.allFinite() && place_m.cwiseAbs().maxCoeff() <= kFarthest_m;
}

inline bool is_share(float value) { return value >= 0.0F && value <= 1.0F; }

/// A length, a standard deviation, a scale.
inline bool is_size(float value) { return value >= 0.0F && std::isfinite(value); }

/// Focal lengths and principal point; not the size.
inline bool is_plausible(const PinholeCamera& camera) {
  const auto is_focal = [](double focal_px) {
    return focal_px >= kShortestFocal_px && focal_px <= kLongestFocal_px;
  };
  return is_focal(camera.fx) && is_focal(camera.fy) && std::abs(camera.cx) <= kLongestFocal_px &&
         std::abs(camera.cy) <= kLongestFocal_px;
}

}  // namespace limbcast::lcm_io
