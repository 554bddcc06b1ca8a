#include "modules/simulate/texture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "modules/simulate/face.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Vector3f;

float lattice(std::int32_t x, std::int32_t y, std::int32_t z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8DA6B343U +
                    static_cast<std::uint32_t>(y) * 0xD8163841U +
                    static_cast<std::uint32_t>(z) * 0xCB1AB31FU;
  h = (h ^ (h >> 15U)) * 0x2C1B3C6DU;
  h = (h ^ (h >> 12U)) * 0x297A2D39U;
  return static_cast<float>((h ^ (h >> 15U)) & 0xFFFFU) / 32767.5F - 1.0F;
}

/// Smooth noise between -1 and 1 with one value a unit (Perlin's value noise).
float value_noise(const Vector3f& p) {
  const Vector3f base = p.array().floor();
  const Vector3f f = p - base;
  const Vector3f s = f.array() * f.array() * (3.0F - 2.0F * f.array());
  const auto x = static_cast<std::int32_t>(base.x());
  const auto y = static_cast<std::int32_t>(base.y());
  const auto z = static_cast<std::int32_t>(base.z());
  const auto line = [&](int dy, int dz) {
    return (1.0F - s.x()) * lattice(x, y + dy, z + dz) + s.x() * lattice(x + 1, y + dy, z + dz);
  };
  const auto plane = [&](int dz) { return (1.0F - s.y()) * line(0, dz) + s.y() * line(1, dz); };
  return (1.0F - s.z()) * plane(0) + s.z() * plane(1);
}

/// Share of the second colour.
float pattern_share(const Material& material, const Vector3f& point) {
  const Vector3f p = point / material.scale_m;
  const auto odd = [](float value) { return std::sin(6.2831853F * value) > 0.0F; };
  switch (material.pattern) {
    case Pattern::kPlain:
    case Pattern::kFace:
      return 0.0F;
    case Pattern::kStripes:
      return odd(p.y()) ? 1.0F : 0.0F;
    case Pattern::kChecks:
      return odd(p.x() + 0.5F * p.z()) != odd(p.y()) ? 1.0F : 0.0F;
    case Pattern::kBlotches:
      return std::clamp(0.5F + 2.0F * value_noise(p), 0.0F, 1.0F);
    case Pattern::kWood: {
      const float rings =
          p.x() + p.z() + 1.5F * value_noise({0.5F * p.x(), 0.1F * p.y(), 0.5F * p.z()});
      return 0.5F + 0.5F * std::sin(6.2831853F * rings);
    }
    case Pattern::kPicture:
      return std::clamp(0.5F + 1.5F * value_noise(p) + value_noise(3.0F * p), 0.0F, 1.0F);
  }
  return 0.0F;
}

}  // namespace

Vector3f texture_color(const Material& material, const Vector3f& point, float footprint_m) {
  const auto vector = [](const Bgr& color) {
    return Vector3f(static_cast<float>(color.b), static_cast<float>(color.g),
                    static_cast<float>(color.r));
  };
  const float share = pattern_share(material, point);
  const Vector3f color =
      material.pattern == Pattern::kFace
          ? face_color(vector(material.color), vector(material.second), point / material.scale_m,
                       footprint_m / material.scale_m)
          : Vector3f((1.0F - share) * vector(material.color) + share * vector(material.second));
  float grain = 0.0F;
  for (const float size_m : {0.003F, 0.007F, 0.016F, 0.040F}) {
    const float sharpness = std::clamp(size_m / footprint_m - 0.7F, 0.0F, 1.0F);
    if (sharpness > 0.0F) grain += sharpness * value_noise(point / size_m);
  }
  return color * (1.0F + material.grain * grain);
}

}  // namespace limbcast::simulate
