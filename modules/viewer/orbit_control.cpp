#include "modules/viewer/orbit_control.hpp"

#include <algorithm>
#include <cmath>

namespace limbcast::viewer {
namespace {

/// How far a key turns [degrees], and by what factor a key or a notch of the wheel goes nearer.
constexpr float kStep_deg = 5.0F, kStepZoom = 1.2F;
/// Across the whole window the mouse turns once around, and from straight above to straight below.
constexpr float kWidth_deg = 360.0F, kHeight_deg = 180.0F;

}  // namespace

void OrbitControl::apply(Look look) {
  switch (look) {
    case Look::kLeft:
      return turn(-kStep_deg, 0.0F);
    case Look::kRight:
      return turn(kStep_deg, 0.0F);
    case Look::kUp:
      return turn(0.0F, kStep_deg);
    case Look::kDown:
      return turn(0.0F, -kStep_deg);
    case Look::kNearer:
      return approach(1.0F);
    case Look::kFarther:
      return approach(-1.0F);
    case Look::kAsAtStart:
      orbit_ = start_;
      return;
  }
}

void OrbitControl::drag(float width_share, float height_share) {
  turn(-kWidth_deg * width_share, kHeight_deg * height_share);
}

void OrbitControl::turn_wheel(float notches) { approach(notches); }

void OrbitControl::turn(float right_deg, float up_deg) {
  orbit_.azimuth_deg = std::remainder(orbit_.azimuth_deg + right_deg, 360.0F);
  orbit_.elevation_deg = std::clamp(orbit_.elevation_deg + up_deg, -90.0F, 90.0F);
}

void OrbitControl::approach(float steps) {
  orbit_.zoom = std::clamp(orbit_.zoom * std::pow(kStepZoom, steps), kMinZoom, kMaxZoom);
}

}  // namespace limbcast::viewer
