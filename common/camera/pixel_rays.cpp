#include "common/camera/pixel_rays.hpp"

#include "common/simd.hpp"

namespace limbcast {
namespace {

LIMBCAST_SIMD void scale_rays(const float* __restrict x, float y, const float* __restrict z_m,
                              int count, float* __restrict coordinates_m) {
  for (int i = 0; i < count; ++i) {
    coordinates_m[3 * i] = x[i] * z_m[i] + 0.0F;  // a hole is at 0, not at -0
    coordinates_m[3 * i + 1] = y * z_m[i] + 0.0F;
    coordinates_m[3 * i + 2] = z_m[i];
  }
}

}  // namespace

PixelRays::PixelRays(const PinholeCamera& camera) : camera_(camera), x_(camera.width) {
  for (int u = 0; u < camera.width; ++u)
    x_[u] = camera.back_project(static_cast<float>(u), 0.0F, 1.0F).x();
}

void PixelRays::back_project_row(int v, const float* z_m, Eigen::Vector3f* points_m) const {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  const float y = camera_.back_project(0.0F, static_cast<float>(v), 1.0F).y();
  scale_rays(x_.data(), y, z_m, camera_.width, points_m->data());
}

}  // namespace limbcast
