#include "modules/reconstructor/depth_to_cloud.hpp"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "modules/reconstructor/colors.hpp"

namespace limbcast::reconstructor {
namespace {

void check(const cv::Mat& depth, const cv::Mat& color, const PinholeCamera& camera) {
  if (depth.type() != CV_16UC1)
    throw std::invalid_argument("depth image must be 16-bit, one channel");
  if (depth.cols != camera.width || depth.rows != camera.height)
    throw std::invalid_argument("depth image has another size than the calibration says");
  if (!color.empty() && color.size() != depth.size())
    throw std::invalid_argument("colour and depth image differ in size");
}

bool has_distortion(const LensCalibration& lens) {
  for (const double coefficient : lens.distortion)
    if (coefficient != 0.0) return true;
  return false;
}

struct UndistortedImages {
  cv::Mat depth, color;
};
UndistortedImages undistort(const cv::Mat& depth, const cv::Mat& color,
                            const LensCalibration& lens) {
  if (!has_distortion(lens)) return {depth, color};
  const PinholeCamera& camera = lens.camera;
  const cv::Matx33d matrix(camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0);
  cv::Mat map, fraction;
  cv::initUndistortRectifyMap(matrix, lens.distortion, cv::noArray(), matrix, depth.size(),
                              CV_16SC2, map, fraction);
  UndistortedImages result;
  // Depths of two surfaces must not be mixed.
  cv::remap(depth, result.depth, map, cv::noArray(), cv::INTER_NEAREST);
  if (!color.empty()) cv::remap(color, result.color, map, fraction, cv::INTER_LINEAR);
  return result;
}

/// Between two surfaces: one neighbour much nearer, the opposite one much farther.
bool is_between(float before_m, float here_m, float after_m, float step_m) {
  if (before_m <= 0.0F || after_m <= 0.0F) return false;
  return (here_m - before_m > step_m && after_m - here_m > step_m) ||
         (before_m - here_m > step_m && here_m - after_m > step_m);
}

}  // namespace

Cloud depth_to_cloud(const cv::Mat& depth, const cv::Mat& color,
                     const DepthCalibration& calibration, const DepthToCloudParams& params) {
  const PinholeCamera& camera = calibration.color.camera;
  check(depth, color, camera);
  const UndistortedImages images = undistort(depth, color, calibration.color);
  Cloud cloud;
  cloud.camera = camera;
  cloud.width = camera.width;
  cloud.height = camera.height;
  cloud.stamp.depth_noise = {static_cast<float>(params.noise_constant_m),
                             static_cast<float>(params.noise_quadratic_per_m)};
  cv::Mat1f depth_m;
  images.depth.convertTo(depth_m, CV_32F, calibration.depth_scale_m);
  depth_m.setTo(0.0F, (depth_m < params.near_limit_m) | (depth_m > params.far_limit_m));

  cloud.points_m.assign(depth_m.total(), Eigen::Vector3f::Zero());
  const auto flying = static_cast<float>(params.flying_step_share);
  std::size_t index = 0;
  for (int v = 0; v < cloud.height; ++v) {
    const float* above = depth_m[std::max(v - 1, 0)];
    const float* row = depth_m[v];
    const float* below = depth_m[std::min(v + 1, cloud.height - 1)];
    for (int u = 0; u < cloud.width; ++u, ++index) {
      const float z_m = row[u];
      if (z_m <= 0.0F) continue;
      const float left_m = row[std::max(u - 1, 0)];
      const float right_m = row[std::min(u + 1, cloud.width - 1)];
      const float step_m = flying * z_m;
      if (flying > 0.0F &&
          (is_between(left_m, z_m, right_m, step_m) || is_between(above[u], z_m, below[u], step_m)))
        continue;
      cloud.points_m[index] =
          camera.back_project(static_cast<float>(u), static_cast<float>(v), z_m);
    }
  }
  cloud.colors = colors_of(images.color);
  return cloud;
}

}  // namespace limbcast::reconstructor
