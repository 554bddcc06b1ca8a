#include "modules/reconstructor/ground_lean.hpp"

#include <Eigen/Core>
#include <cmath>

#include "common/angle.hpp"
#include "common/cloud/ground_plane.hpp"

namespace limbcast::reconstructor {
namespace {

/// The ground is looked for so far from gravity: a lean of half of this is told long before [rad].
constexpr double kMostLean_rad = 0.15;
/// Distance to the plane that still counts as ground [m]: a turn moves disparities at the image's
/// sides by a third more than in its middle, so that the ground comes out curved. Of recordings
/// with a turn of 0.57 degrees 3 cm, as elsewhere, leave half of the frames without ground.
constexpr double kCurved_m = 0.06;
/// Share of gravity in the image's plane, below which the camera looks down [sine of 30 degrees].
constexpr float kLeastInImage = 0.5F;

bool is_told(const Gravity& gravity) {
  return gravity.source == GravitySource::kRecording || gravity.source == GravitySource::kOption;
}

}  // namespace

std::optional<GroundLean> ground_lean(const Cloud& cloud, double focal_baseline_px_m) {
  const Gravity& gravity = cloud.stamp.gravity;
  const Eigen::Vector2f told_in_image = gravity.down.head<2>();
  if (!is_told(gravity) || told_in_image.norm() < kLeastInImage) return std::nullopt;
  GroundPlaneParams params;
  params.max_tilt_rad = kMostLean_rad;
  params.inlier_distance_m = kCurved_m;
  const auto ground = find_ground_plane(cloud, gravity.down, params);
  if (!ground) return std::nullopt;
  const Eigen::Vector3f seen = ground->down / ground->height_m;
  // The height at which told gravity meets what is seen across the image, which no offset moves.
  const float per_height = told_in_image.dot(seen.head<2>()) / told_in_image.squaredNorm();
  const Eigen::Vector3f told = per_height * gravity.down;
  const float leaned = seen.z() - told.z();
  return GroundLean{
      focal_baseline_px_m * leaned,
      std::copysign(angle_deg(Eigen::Vector3f(told + Eigen::Vector3f(0, 0, leaned)), told),
                    leaned)};
}

}  // namespace limbcast::reconstructor
