#include "common/lcm_io/point_cloud_codec.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "common/camera/pixel_rays.hpp"
#include "common/lcm_io/compression.hpp"
#include "common/lcm_io/image_codec.hpp"
#include "common/lcm_io/message_error.hpp"
#include "common/lcm_io/plausible.hpp"
#include "common/lcm_io/quantization.hpp"
#include "common/lcm_io/stamp_codec.hpp"
#include "common/simd.hpp"

namespace limbcast::lcm_io {
namespace {

/// Depths of a camera's points as the message carries them. Row by row, so that what lies between
/// the steps stays in the cache.
std::vector<std::uint16_t> depth_codes(const Cloud& cloud, double inverse_depth_scale) {
  std::vector<std::uint16_t> codes(cloud.points_m.size());
  std::vector<float> depths_m(cloud.width);
  for (int v = 0; v < cloud.height; ++v) {
    const std::size_t first = static_cast<std::size_t>(v) * cloud.width;
    for (int u = 0; u < cloud.width; ++u) depths_m[u] = cloud.points_m[first + u].z();
    quantize_depths(depths_m.data(), depths_m.size(), inverse_depth_scale, codes.data() + first);
  }
  return codes;
}

/// is_plausible() for each of some points, without branches: in a sixth of the time.
LIMBCAST_SIMD bool are_plausible(const float* coordinates_m, std::size_t count) {
  int num_beyond = 0;
  for (std::size_t i = 0; i < count; ++i)
    num_beyond += std::abs(coordinates_m[i]) <= kFarthest_m ? 0 : 1;  // so is what is no number
  return num_beyond == 0;
}

void check_plausible(const Eigen::Vector3f* points_m, std::size_t count) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  require(count == 0 || are_plausible(points_m->data(), 3 * count),
          "point cloud: a point is farther than any sensor sees");
}

cv::Mat color_image(const Cloud& cloud) {
  static_assert(sizeof(Bgr) == 3, "colours must lie as in an 8-bit BGR image");
  if (cloud.colors.empty()) return {};
  // OpenCV has no view of constant data; the image is only read.
  auto* data = const_cast<Bgr*>(cloud.colors.data());
  return {cloud.height, cloud.width, CV_8UC3, data};
}

std::vector<Bgr> colors_of(const cv::Mat& image, const Cloud& cloud) {
  if (image.empty()) return {};
  require(image.cols == cloud.width && image.rows == cloud.height && image.depth() == CV_8U,
          "point cloud: colour image has another size or depth");
  cv::Mat bgr = image;
  if (image.channels() == 1) cv::cvtColor(image, bgr, cv::COLOR_GRAY2BGR);
  std::vector<Bgr> colors(cloud.points_m.size());
  std::memcpy(colors.data(), bgr.data, colors.size() * sizeof(Bgr));
  return colors;
}

void read_camera_layout(const point_cloud_t& message, Cloud& cloud) {
  cloud.camera =
      PinholeCamera{message.width, message.height, message.fx, message.fy, message.cx, message.cy};
  require(is_plausible(*cloud.camera), "point cloud: camera is not sound");
  require(std::isfinite(message.inverse_depth_scale) && message.inverse_depth_scale > 0.0,
          "point cloud: 'inverse_depth_scale' is not positive");
  const std::vector<std::uint16_t> codes =
      decode_lattice(message.points, message.width, message.height);
  if (codes.empty()) return;  // the other side may be of any length
  const PixelRays rays(*cloud.camera);
  std::vector<float> depths_m(message.width);
  cloud.points_m.resize(codes.size());
  for (int v = 0; v < message.height; ++v) {
    const std::size_t first = static_cast<std::size_t>(v) * message.width;
    dequantize_depths(codes.data() + first, depths_m.size(), message.inverse_depth_scale,
                      depths_m.data());
    rays.back_project_row(v, depths_m.data(), cloud.points_m.data() + first);
    check_plausible(cloud.points_m.data() + first, depths_m.size());
  }
}

void read_list_layout(const point_cloud_t& message, Cloud& cloud) {
  require(message.height == 1, "point cloud: a list has height 1");
  require(std::isfinite(message.resolution_m) && message.resolution_m > 0.0,
          "point cloud: 'resolution_m' is not positive");
  cloud.points_m = dequantize_points(
      decode_sequence(message.points, static_cast<std::size_t>(message.width) * 3),
      message.resolution_m);
  check_plausible(cloud.points_m.data(), cloud.points_m.size());
}

void write_laser_values(const Cloud& cloud, point_cloud_t& message) {
  if (!cloud.intensities.empty()) {
    message.intensity_step = value_step(cloud.intensities);
    message.intensities =
        encode_sequence(quantize_values(cloud.intensities, message.intensity_step));
  }
  if (!cloud.rings.empty()) {
    // The coding works modulo 2^16, so it carries unsigned numbers as well.
    message.rings = encode_sequence({cloud.rings.begin(), cloud.rings.end()});
  }
  message.intensities_size = static_cast<std::int32_t>(message.intensities.size());
  message.rings_size = static_cast<std::int32_t>(message.rings.size());
}

void read_laser_values(const point_cloud_t& message, Cloud& cloud) {
  if (!message.intensities.empty()) {
    require(std::isfinite(message.intensity_step) && message.intensity_step > 0.0,
            "point cloud: 'intensity_step' is not positive");
    cloud.intensities = dequantize_values(
        decode_sequence(message.intensities, cloud.points_m.size()), message.intensity_step);
  }
  if (!message.rings.empty()) {
    const std::vector<std::int16_t> codes = decode_sequence(message.rings, cloud.points_m.size());
    cloud.rings.assign(codes.begin(), codes.end());
  }
}

}  // namespace

point_cloud_t to_message(const Cloud& cloud, int jpeg_quality) {
  point_cloud_t message{};
  message.stamp = to_message(cloud.stamp);
  message.width = cloud.width;
  message.height = cloud.height;
  if (cloud.camera) {
    message.layout = point_cloud_t::CAMERA;
    message.fx = cloud.camera->fx;
    message.fy = cloud.camera->fy;
    message.cx = cloud.camera->cx;
    message.cy = cloud.camera->cy;
    message.inverse_depth_scale = inverse_depth_scale(cloud.stamp.depth_noise);
    message.points =
        encode_lattice(depth_codes(cloud, message.inverse_depth_scale), cloud.width, cloud.height);
    message.color = to_jpeg_message(color_image(cloud), jpeg_quality);
  } else {
    message.layout = point_cloud_t::LIST;
    message.resolution_m = list_resolution_m(cloud.points_m);
    message.points = encode_sequence(quantize_points(cloud.points_m, message.resolution_m));
    message.color = to_raw_message(color_image(cloud));
  }
  message.points_size = static_cast<std::int32_t>(message.points.size());
  write_laser_values(cloud, message);
  return message;
}

Cloud from_message(const point_cloud_t& message) {
  Cloud cloud;
  cloud.stamp = from_message(message.stamp);
  require(message.width >= 0 && message.height >= 0 &&
              static_cast<std::int64_t>(message.width) * message.height <= kMaxPoints,
          "point cloud: size is out of range");
  cloud.width = message.width;
  cloud.height = message.height;
  require(message.layout == point_cloud_t::CAMERA || message.layout == point_cloud_t::LIST,
          "point cloud: unknown layout");
  if (message.layout == point_cloud_t::CAMERA)
    read_camera_layout(message, cloud);
  else
    read_list_layout(message, cloud);
  // A list's colours are as wide as the list, which is more than an image may be: they are read as
  // bytes.
  if (message.layout == point_cloud_t::LIST && !message.color.data.empty()) {
    require(message.color.encoding == image_t::RAW_BGR8 &&
                message.color.data.size() == cloud.points_m.size() * sizeof(Bgr),
            "point cloud: colours of a list are not three bytes a point");
    cloud.colors.resize(cloud.points_m.size());
    std::memcpy(cloud.colors.data(), message.color.data.data(), message.color.data.size());
  } else {
    cloud.colors = colors_of(from_message(message.color), cloud);
  }
  read_laser_values(message, cloud);
  return cloud;
}

}  // namespace limbcast::lcm_io
