#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/types.hpp>
#include <optional>

#include "common/camera/pinhole_camera.hpp"
#include "modules/viewer/view_frame.hpp"

namespace limbcast::viewer {

/// A camera to look through: the sensor's own or one put beside or above the people.
struct Viewpoint {
  PinholeCamera camera;
  Eigen::Isometry3f eye_from_frame = Eigen::Isometry3f::Identity();

  cv::Size size() const { return {camera.width, camera.height}; }
  /// Pixel of a point of the frame; nothing for points behind the eye.
  std::optional<cv::Point2f> project(const Eigen::Vector3f& point_m) const;
};

/// From where to look at the people: turned by `azimuth_deg` about gravity (0: where the sensor
/// stands; positive: to the right of the image), raised by `elevation_deg` (90: straight above,
/// -90: straight below), and `zoom` times nearer than where all of them can be seen.
struct Orbit {
  float azimuth_deg = 0.0F, elevation_deg = 0.0F, zoom = 1.0F;
};
/// Nearer, the eye would be among the people; farther, they would be a few pixels.
inline constexpr float kMinZoom = 0.2F, kMaxZoom = 10.0F;

/// The sensor's own view, where it has a camera.
std::optional<Viewpoint> sensor_view(const ViewFrame& frame);
/// A view of the people (of the whole cloud where there are none) from anywhere around them.
Viewpoint orbit_view(const ViewFrame& frame, const Orbit& orbit, cv::Size size);

}  // namespace limbcast::viewer
