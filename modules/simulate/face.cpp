#include "modules/simulate/face.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace limbcast::simulate {
namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

/// An ellipse painted on the front of the head; on both halves of the face.
struct Feature {
  float x, y, half_x, half_y;  ///< [fractions of stature]
  enum class Paint : std::uint8_t { kSkin, kBrow, kColor } paint;
  float b, g, r;  ///< the colour, or what the skin's or the brow's is multiplied by
};

using Paint = Feature::Paint;
/// From the lowest layer to the uppermost.
constexpr Feature kFeatures[] = {
    {0.0175F, -0.0020F, 0.0130F, 0.0085F, Paint::kSkin, 0.84F, 0.84F, 0.86F},      // eye socket
    {0.0180F, -0.0060F, 0.0086F, 0.0040F, Paint::kColor, 172.0F, 176.0F, 180.0F},  // eyeball
    {0.0180F, -0.0056F, 0.0041F, 0.0041F, Paint::kColor, 34.0F, 42.0F, 56.0F},     // iris and pupil
    {0.0180F, -0.0022F, 0.0094F, 0.0014F, Paint::kSkin, 0.40F, 0.40F, 0.45F},      // lashes
    {0.0185F, 0.0066F, 0.0120F, 0.0026F, Paint::kBrow, 0.70F, 0.70F, 0.70F},       // brow
    {0.0045F, -0.0275F, 0.0030F, 0.0016F, Paint::kSkin, 0.45F, 0.45F, 0.50F},      // nostril
    {0.0F, -0.0440F, 0.0140F, 0.0050F, Paint::kSkin, 0.70F, 0.64F, 0.86F},         // lips
    {0.0F, -0.0438F, 0.0145F, 0.0009F, Paint::kSkin, 0.38F, 0.36F, 0.45F},  // between the lips
};

/// Share of a pixel at (x, y) that the ellipse covers.
float coverage(const Feature& feature, float x, float y, float footprint) {
  const float u = (x - feature.x) / feature.half_x;
  const float v = (y - feature.y) / feature.half_y;
  const float radius = std::sqrt(u * u + v * v);
  const float least = std::min(feature.half_x, feature.half_y);
  // A feature that is narrower than the pixel fills a part of it only.
  const float most = std::min(1.0F, 2.0F * least / footprint);
  return most * std::clamp(0.5F - (radius - 1.0F) * least / footprint, 0.0F, 1.0F);
}

}  // namespace

Vector3f face_color(const Vector3f& skin, const Vector3f& brows, const Vector3f& place,
                    float footprint) {
  Array3f color = skin;
  if (place.z() < 0.0F) return color;
  for (const Feature& feature : kFeatures) {
    const float share = coverage(feature, std::abs(place.x()), place.y(), footprint);
    if (share == 0.0F) continue;
    Array3f paint(feature.b, feature.g, feature.r);
    if (feature.paint != Paint::kColor)
      paint *= (feature.paint == Paint::kSkin ? skin : brows).array();
    color += share * (paint - color);
  }
  return color;
}

}  // namespace limbcast::simulate
