#include "modules/reconstructor/triangulation.hpp"

#include "modules/reconstructor/colors.hpp"

namespace limbcast::reconstructor {

Cloud triangulate(const DisparityImage& disparity, const cv::Mat& color,
                  const PinholeCamera& camera, double baseline_m,
                  const TriangulationParams& params) {
  Cloud cloud;
  cloud.camera = camera;
  cloud.width = camera.width;
  cloud.height = camera.height;
  cloud.points_m.assign(static_cast<std::size_t>(camera.width) * camera.height,
                        Eigen::Vector3f::Zero());
  const double focal_baseline = camera.fx * baseline_m;
  cloud.stamp.depth_noise = {0.0F, static_cast<float>(params.sigma_disparity_px / focal_baseline)};

  const auto scale = static_cast<float>(focal_baseline);
  const auto nearest = static_cast<float>(focal_baseline / params.near_limit_m);
  const auto farthest = static_cast<float>(focal_baseline / params.far_limit_m);
  std::size_t index = 0;
  for (int v = 0; v < cloud.height; ++v) {
    const float* row = disparity.disparity_px[v];
    for (int u = 0; u < cloud.width; ++u, ++index) {
      if (row[u] <= 0.0F || row[u] < farthest || row[u] > nearest) continue;
      cloud.points_m[index] =
          camera.back_project(static_cast<float>(u), static_cast<float>(v), scale / row[u]);
    }
  }
  cloud.colors = colors_of(color);
  return cloud;
}

}  // namespace limbcast::reconstructor
