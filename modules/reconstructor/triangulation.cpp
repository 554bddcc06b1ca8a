#include "modules/reconstructor/triangulation.hpp"

#include <vector>

#include "common/camera/pixel_rays.hpp"
#include "common/simd.hpp"
#include "modules/reconstructor/colors.hpp"

namespace limbcast::reconstructor {
namespace {

/// Disparities a cloud is made of [px].
struct Range {
  float farthest_px, nearest_px;
};

/// 0 where there is no disparity, or one out of range.
LIMBCAST_SIMD void distances_of(const float* __restrict disparity_px, int count, Range range,
                                float focal_baseline, float* __restrict z_m) {
  for (int u = 0; u < count; ++u) {
    const bool seen = disparity_px[u] > 0.0F && disparity_px[u] >= range.farthest_px &&
                      disparity_px[u] <= range.nearest_px;
    const float distance_m = focal_baseline / disparity_px[u];
    z_m[u] = seen ? distance_m : 0.0F;
  }
}

}  // namespace

Cloud triangulate(const DisparityImage& disparity, const cv::Mat& color,
                  const PinholeCamera& camera, double baseline_m,
                  const TriangulationParams& params) {
  Cloud cloud;
  cloud.camera = camera;
  cloud.width = camera.width;
  cloud.height = camera.height;
  cloud.points_m.resize(static_cast<std::size_t>(camera.width) * camera.height);
  const double focal_baseline = camera.fx * baseline_m;
  cloud.stamp.depth_noise = {0.0F, static_cast<float>(params.sigma_disparity_px / focal_baseline)};

  const Range range{static_cast<float>(focal_baseline / params.far_limit_m),
                    static_cast<float>(focal_baseline / params.near_limit_m)};
  const PixelRays rays(camera);
  std::vector<float> z_m(camera.width);
  for (int v = 0; v < cloud.height; ++v) {
    distances_of(disparity.disparity_px[v], cloud.width, range, static_cast<float>(focal_baseline),
                 z_m.data());
    rays.back_project_row(v, z_m.data(),
                          &cloud.points_m[static_cast<std::size_t>(v) * cloud.width]);
  }
  cloud.colors = colors_of(color);
  return cloud;
}

}  // namespace limbcast::reconstructor
