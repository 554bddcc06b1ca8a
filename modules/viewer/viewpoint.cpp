#include "modules/viewer/viewpoint.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/median.hpp"

namespace limbcast::viewer {
namespace {

constexpr float kRadians = 0.0174532925F;
/// Points nearer to the eye than this are not drawn [m].
constexpr float kNear = 0.1F;
/// Radius of what a view shows at least, and at most [m]: a standing person with a raised arm; a
/// room.
constexpr float kMinRadius = 1.3F, kMaxRadius = 3.5F;
/// Focal length in units of the picture's height.
constexpr float kFocal = 1.2F;

struct Ball {
  Eigen::Vector3f center_m = Eigen::Vector3f(0.0F, 0.0F, 3.0F);
  float radius_m = kMaxRadius;
};

void append_joints(const std::optional<BodyPoses>& poses, std::vector<Eigen::Vector3f>& points) {
  if (!poses) return;
  for (const BodyPose& person : poses->persons) {
    for (const JointEstimate& joint : person.joints) {
      if (joint.valid) points.push_back(joint.position_m);
    }
  }
}

void append_points(const ViewFrame& frame, std::vector<Eigen::Vector3f>& points) {
  if (frame.segments) {
    for (const Segment& segment : frame.segments->segments) {
      if (segment.valid())
        points.insert(points.end(), segment.points_m.begin(), segment.points_m.end());
    }
  }
  if (!points.empty() || !frame.cloud) return;
  for (std::size_t i = 0; i < frame.cloud->points_m.size(); ++i) {
    if (!frame.cloud->is_hole(i)) points.push_back(frame.cloud->points_m[i]);
  }
}

/// What a view should show: people where there are any, else the cloud.
Ball interesting_part(const ViewFrame& frame) {
  std::vector<Eigen::Vector3f> points;
  append_joints(frame.poses, points);
  append_joints(frame.truth, points);
  if (points.empty()) append_points(frame, points);
  Ball ball;
  if (points.empty()) return ball;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    values.reserve(points.size());
    for (const Eigen::Vector3f& point : points) values.push_back(point[axis]);
    ball.center_m[axis] = median(std::move(values));
  }
  float radius_m = 0.0F;
  for (const Eigen::Vector3f& point : points)
    radius_m = std::max(radius_m, (point - ball.center_m).norm());
  ball.radius_m = std::clamp(radius_m, kMinRadius, kMaxRadius);
  return ball;
}

/// Horizontal direction in which the sensor looks.
Eigen::Vector3f horizontal_forward(const Eigen::Vector3f& down) {
  const Eigen::Vector3f optical = Eigen::Vector3f::UnitZ();
  const Eigen::Vector3f forward = optical - optical.dot(down) * down;
  // A sensor that looks straight down: up in the image is as good as any direction.
  if (forward.norm() < 1e-3F) return -Eigen::Vector3f::UnitY();
  return forward.normalized();
}

}  // namespace

std::optional<cv::Point2f> Viewpoint::project(const Eigen::Vector3f& point_m) const {
  const Eigen::Vector3f seen = eye_from_frame * point_m;
  if (seen.z() < kNear) return std::nullopt;
  const Eigen::Vector2f pixel = camera.project(seen);
  return cv::Point2f(pixel.x(), pixel.y());
}

std::optional<Viewpoint> sensor_view(const ViewFrame& frame) {
  if (!frame.cloud || !frame.cloud->camera) return std::nullopt;
  return Viewpoint{*frame.cloud->camera, Eigen::Isometry3f::Identity()};
}

Viewpoint orbit_view(const ViewFrame& frame, const Orbit& orbit, cv::Size size) {
  const Ball ball = interesting_part(frame);
  const Eigen::Vector3f down = frame.stamp.gravity.down;
  // Standing to the right of the image means looking to the left: a turn against gravity's sense.
  const Eigen::AngleAxisf turn(-orbit.azimuth_deg * kRadians, down);
  // Straight above or below, right and left would be lost.
  const float elevation = std::clamp(orbit.elevation_deg, -89.0F, 89.0F) * kRadians;
  const Eigen::Vector3f look =
      std::cos(elevation) * (turn * horizontal_forward(down)) + std::sin(elevation) * down;
  const Eigen::Vector3f right = down.cross(look).normalized();
  Eigen::Matrix3f eye_axes;
  eye_axes << right.transpose(), look.cross(right).transpose(), look.transpose();

  Viewpoint view;
  const float focal_px = kFocal * static_cast<float>(size.height);
  view.camera = {size.width, size.height, focal_px, focal_px, 0.5 * size.width, 0.5 * size.height};
  const float distance_m = 2.0F * kFocal * 1.1F * ball.radius_m / orbit.zoom;
  view.eye_from_frame.linear() = eye_axes;
  view.eye_from_frame.translation() = -eye_axes * (ball.center_m - distance_m * look);
  return view;
}

}  // namespace limbcast::viewer
