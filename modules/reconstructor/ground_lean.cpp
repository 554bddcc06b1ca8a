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

/// The cloud as it would be with disparities smaller by `offset_px`; what then lies at infinity is
/// a hole.
Cloud without_offset(Cloud cloud, double offset_px, double focal_baseline_px_m) {
  const auto per_depth = static_cast<float>(offset_px / focal_baseline_px_m);
  for (Eigen::Vector3f& point_m : cloud.points_m) {
    const float left = 1.0F - per_depth * point_m.z();
    point_m = left > 0.0F ? Eigen::Vector3f(point_m / left) : Eigen::Vector3f::Zero();
  }
  return cloud;
}

/// n / h of the ground that is seen, and of one that lies as gravity tells and comes nearest to it
/// across the image, where no offset of disparities moves it [1/m].
struct Grounds {
  Eigen::Vector3f seen, told;
  float leaned() const { return seen.z() - told.z(); }
};

std::optional<Grounds> grounds_in(const Cloud& cloud) {
  GroundPlaneParams params;
  params.max_tilt_rad = kMostLean_rad;
  params.inlier_distance_m = kCurved_m;
  const Eigen::Vector3f& down = cloud.stamp.gravity.down;
  const auto ground = find_ground_plane(cloud, down, params);
  if (!ground) return std::nullopt;
  const Eigen::Vector3f seen = ground->down / ground->height_m;
  const Eigen::Vector2f in_image = down.head<2>();
  return Grounds{seen, in_image.dot(seen.head<2>()) / in_image.squaredNorm() * down};
}

}  // namespace

std::optional<GroundLean> ground_lean(const Cloud& cloud, double focal_baseline_px_m) {
  const Gravity& gravity = cloud.stamp.gravity;
  if (!is_told(gravity) || gravity.down.head<2>().norm() < kLeastInImage) return std::nullopt;
  const auto first = grounds_in(cloud);
  if (!first) return std::nullopt;
  // A turn bends the ground, and a plane through it is drawn to where it bends most. Without what
  // was found so far it is nearly flat, and what is left is measured well.
  const double first_px = focal_baseline_px_m * first->leaned();
  const auto second = grounds_in(without_offset(cloud, first_px, focal_baseline_px_m));
  if (!second) return std::nullopt;
  const float leaned = first->leaned() + second->leaned();
  const Eigen::Vector3f& told = second->told;
  return GroundLean{
      focal_baseline_px_m * leaned,
      std::copysign(angle_deg(Eigen::Vector3f(told + Eigen::Vector3f(0, 0, leaned)), told),
                    leaned)};
}

}  // namespace limbcast::reconstructor
