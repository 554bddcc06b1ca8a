#pragma once

#include <cmath>
#include <cstdint>
#include <functional>

#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"

namespace limbcast::segmenter {

inline constexpr int kSceneWidth = 160, kSceneHeight = 240;
inline constexpr float kFocal_px = 260.0F;
inline constexpr float kBody_m = 3.0F;

/// Depth at a place across and up from the middle of the view, measured at the body's depth.
using DrawnScene = std::function<float(float right_m, float up_m)>;

/// What a level camera sees of a scene; the ground is not known.
inline Lattice look_at(const DrawnScene& depth_at) {
  Lattice lattice;
  lattice.width = kSceneWidth;
  lattice.height = kSceneHeight;
  lattice.focal_px = kFocal_px;
  lattice.frame = make_level_frame(Gravity{}, std::nullopt);
  for (int v = 0; v < kSceneHeight; ++v) {
    for (int u = 0; u < kSceneWidth; ++u) {
      const float right = (static_cast<float>(u) - 0.5F * kSceneWidth) / kFocal_px,
                  up = (0.5F * kSceneHeight - static_cast<float>(v)) / kFocal_px;
      const float z_m = depth_at(right * kBody_m, up * kBody_m);
      lattice.depth_m.push_back(z_m);
      lattice.level_m.emplace_back(right * z_m, z_m, up * z_m);
      lattice.source.push_back(static_cast<std::uint32_t>(lattice.source.size()));
    }
  }
  return lattice;
}

inline std::uint32_t index_at(const Lattice& lattice, float right_m, float up_m) {
  const int u = kSceneWidth / 2 + static_cast<int>(right_m / kBody_m * kFocal_px),
            v = kSceneHeight / 2 - static_cast<int>(up_m / kBody_m * kFocal_px);
  return static_cast<std::uint32_t>(lattice.index(u, v));
}

inline HeadCandidate head_at(const Lattice& lattice, float right_m, float up_m) {
  const auto i = static_cast<int>(index_at(lattice, right_m, up_m));
  HeadCandidate head;
  head.u = i % kSceneWidth;
  head.v = i / kSceneWidth;
  head.surface_m = lattice.level_m[static_cast<std::size_t>(i)];
  head.center_m = head_center(lattice, head.surface_m);
  return head;
}

}  // namespace limbcast::segmenter
