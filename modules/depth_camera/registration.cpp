#include "modules/depth_camera/registration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/camera/lens_projection.hpp"

namespace limbcast::depth_camera {
namespace {

std::vector<cv::Point2d> rays_of(const LensCalibration& lens) {
  std::vector<cv::Point2d> pixels;
  pixels.reserve(static_cast<std::size_t>(lens.camera.width) * lens.camera.height);
  for (int v = 0; v < lens.camera.height; ++v) {
    for (int u = 0; u < lens.camera.width; ++u) pixels.emplace_back(u, v);
  }
  std::vector<cv::Point2d> rays;
  undistort_points(pixels, rays, lens);
  return rays;
}

/// Writes `depth` into the pixels within `half_width_px` of `pixel` where nothing nearer stands.
void draw_nearest(cv::Mat1w& image, const cv::Point2d& pixel, double half_width_px,
                  std::uint16_t depth) {
  const auto first = [&](double middle) {
    return std::max(0, static_cast<int>(std::ceil(middle - half_width_px)));
  };
  const auto last = [&](double middle, int size) {
    return std::min(size - 1, static_cast<int>(std::floor(middle + half_width_px)));
  };
  for (int v = first(pixel.y); v <= last(pixel.y, image.rows); ++v) {
    for (int u = first(pixel.x); u <= last(pixel.x, image.cols); ++u) {
      std::uint16_t& nearest = image(v, u);
      if (nearest == 0 || depth < nearest) nearest = depth;
    }
  }
}

}  // namespace

DepthRegistration::DepthRegistration(const DepthCalibration& calibration)
    : color_(calibration.color),
      depth_camera_(calibration.depth_camera.value()),
      depth_scale_m_(calibration.depth_scale_m),
      rays_(rays_of(depth_camera_.lens)) {}

cv::Mat1w DepthRegistration::registered(const cv::Mat& depth) const {
  std::vector<cv::Point3d> points_m;  // in the colour camera's frame
  std::vector<double> half_widths_px;
  const double focal_ratio = color_.camera.fx / depth_camera_.lens.camera.fx;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const std::uint16_t value =
        depth.at<std::uint16_t>(static_cast<int>(i) / depth.cols, static_cast<int>(i) % depth.cols);
    if (value == 0) continue;
    const double z_m = depth_scale_m_ * value;
    const Eigen::Vector3d point =
        depth_camera_.R * Eigen::Vector3d(z_m * rays_[i].x, z_m * rays_[i].y, z_m) +
        depth_camera_.T;
    if (point.z() <= 0.0) continue;
    points_m.emplace_back(point.x(), point.y(), point.z());
    // A pixel of the depth image is so large in the colour image; smaller ones would leave gaps.
    half_widths_px.push_back(std::max(0.5, 0.5 * focal_ratio * z_m / point.z()));
  }
  cv::Mat1w result(color_.camera.height, color_.camera.width, std::uint16_t{0});
  if (points_m.empty()) return result;
  std::vector<cv::Point2d> pixels;
  project_points(points_m, cv::Vec3d::all(0.0), cv::Vec3d::all(0.0), color_, pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const long value = std::lround(points_m[i].z / depth_scale_m_);
    if (value < 1 || value > std::numeric_limits<std::uint16_t>::max()) continue;
    draw_nearest(result, pixels[i], half_widths_px[i], static_cast<std::uint16_t>(value));
  }
  return result;
}

}  // namespace limbcast::depth_camera
