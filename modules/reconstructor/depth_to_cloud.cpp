#include "modules/reconstructor/depth_to_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "common/camera/opencv_conversion.hpp"
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

/// Between two surfaces: one neighbour much nearer, the opposite one much farther.
bool is_between(float before_m, float here_m, float after_m, float step_m) {
  if (before_m <= 0.0F || after_m <= 0.0F) return false;
  return (here_m - before_m > step_m && after_m - here_m > step_m) ||
         (before_m - here_m > step_m && here_m - after_m > step_m);
}

/// Whether the surface at a pixel leads from one object to another, as sensors that smooth their
/// depth make it: on both sides it is steeper than a surface that is still seen.
bool is_flying(const cv::Mat1f& depth_m, int u, int v, const PinholeCamera& camera,
               const DepthToCloudParams& params) {
  const float z_m = depth_m(v, u);
  const auto px_per_m = static_cast<float>(camera.fx) / z_m;
  const int reach_px =
      std::max(1, static_cast<int>(std::lround(params.flying_window_m * px_per_m)));
  const auto run_m = static_cast<float>(reach_px) / px_per_m;
  const auto at = [&](int du, int dv) {
    return depth_m(std::clamp(v + dv, 0, depth_m.rows - 1),
                   std::clamp(u + du, 0, depth_m.cols - 1));
  };
  const auto across = static_cast<float>(params.max_slope_across);
  const auto upwards = static_cast<float>(params.max_slope_upwards);
  return (across > 0.0F && is_between(at(-reach_px, 0), z_m, at(reach_px, 0), across * run_m)) ||
         (upwards > 0.0F && is_between(at(0, -reach_px), z_m, at(0, reach_px), upwards * run_m));
}

}  // namespace

DepthToCloud::DepthToCloud(const DepthCalibration& calibration, const DepthToCloudParams& params)
    : camera_(calibration.color.camera),
      depth_scale_m_(calibration.depth_scale_m),
      params_(params) {
  if (!has_distortion(calibration.color)) return;
  color_maps_ = undistorting_maps(calibration.color, cv::noArray(), camera_matrix(camera_),
                                  cv::Size(camera_.width, camera_.height));
  // The maps' whole pixels alone are rounded down, half a pixel off on average.
  cv::convertMaps(color_maps_.xy, color_maps_.fraction, depth_map_, cv::noArray(), CV_32FC2);
}

DepthToCloud::Images DepthToCloud::undistort(const Images& images) const {
  if (depth_map_.empty()) return images;
  Images result;
  // Depths of two surfaces must not be mixed: the nearest pixel's is taken.
  cv::remap(images.depth, result.depth, depth_map_, cv::noArray(), cv::INTER_NEAREST);
  if (!images.color.empty())
    cv::remap(images.color, result.color, color_maps_.xy, color_maps_.fraction, cv::INTER_LINEAR);
  return result;
}

Cloud DepthToCloud::cloud_of(const cv::Mat& depth, const cv::Mat& color) const {
  check(depth, color, camera_);
  const Images images = undistort({depth, color});
  Cloud cloud;
  cloud.camera = camera_;
  cloud.width = camera_.width;
  cloud.height = camera_.height;
  cloud.stamp.depth_noise = {static_cast<float>(params_.noise_constant_m),
                             static_cast<float>(params_.noise_quadratic_per_m)};
  cv::Mat1f depth_m;
  images.depth.convertTo(depth_m, CV_32F, depth_scale_m_);
  depth_m.setTo(0.0F, (depth_m < params_.near_limit_m) | (depth_m > params_.far_limit_m));

  cloud.points_m.assign(depth_m.total(), Eigen::Vector3f::Zero());
  std::size_t index = 0;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u, ++index) {
      if (depth_m(v, u) <= 0.0F || is_flying(depth_m, u, v, camera_, params_)) continue;
      cloud.points_m[index] =
          camera_.back_project(static_cast<float>(u), static_cast<float>(v), depth_m(v, u));
    }
  }
  cloud.colors = colors_of(images.color);
  return cloud;
}

}  // namespace limbcast::reconstructor
