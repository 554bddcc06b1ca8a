#include "tests/pose_fitter/refined/refined_body.hpp"

#include <algorithm>
#include <cmath>

#include "modules/pose_fitter/refined/cost/image_term.hpp"

namespace limbcast::pose_fitter::testing {
namespace {

using refined::Cones;
using refined::Vec3;

constexpr double kCameraHeightM = 1.2;

double distance_to(const Cones& cones, const Vec3& point) {
  double nearest = 1e9;
  for (const refined::Cone& cone : cones) {
    const double t = cone.nearest(point);
    nearest = std::min(nearest, (point - cone.point(t)).norm() - cone.radius(t));
  }
  return nearest;
}

/// Depth along the optical axis where the pixel's ray meets the body, 0 where it misses (sphere
/// tracing).
double depth_at(const Cones& cones, const Vec3& ray, double first_m, double last_m) {
  for (double along = first_m; along < last_m;) {
    const double distance = distance_to(cones, along * ray);
    if (distance < 0.002) return along * ray.z();
    along += distance;
  }
  return 0.0;
}

}  // namespace

PinholeCamera camera() { return {640, 480, 520.0, 520.0, 319.5, 239.5}; }

Stamp stamp() {
  Stamp stamp;
  stamp.gravity.down = {0.0F, 1.0F, 0.0F};
  stamp.gravity.sensor_height_m = static_cast<float>(kCameraHeightM);
  stamp.depth_noise = {0.005F, 0.0F};
  return stamp;
}

refined::BodyState standing_body(double distance_m, double yaw_rad) {
  const double stature_m = 1.75, head_height_m = 0.95 * stature_m;
  return refined::rest_body({0.0, kCameraHeightM - head_height_m, distance_m}, {0.0, -1.0, 0.0},
                            yaw_rad, std::log(stature_m / refined::kReferenceStatureM),
                            refined::Legs::kStanding);
}

void point_with(refined::BodyState& body, int side, const Eigen::Vector3d& direction) {
  const Vec3 way = direction.normalized();
  Vec3 in_body = body.rotation.transpose() * way;
  in_body.x() *= refined::side_sign(side);
  Vec3 offset = refined::shoulder_offset(in_body);
  offset.x() *= refined::side_sign(side);
  auto& points = body.points;
  points[refined::kShoulder + side] =
      points[refined::kNeck] + body.rotation * (body.stature_m() * offset);
  points[refined::kElbow + side] =
      points[refined::kShoulder + side] + 0.147 * body.stature_m() * way;
  points[refined::kWrist + side] = points[refined::kElbow + side] + 0.1465 * body.stature_m() * way;
  points[refined::kHand + side] = points[refined::kWrist + side] + 0.044 * body.stature_m() * way;
}

Segment seen(const refined::BodyState& body, int occluder_u, const PinholeCamera& image_camera) {
  const Cones cones = refined::make_cones_of(body);
  const double head_z = body.points[refined::kHead].z();
  Segment segment;
  RangeImage image;
  image.camera = image_camera;
  image.full_width = image.camera.width;
  image.full_height = image.camera.height;
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      const Vec3 ray = image.camera.back_project(static_cast<float>(u), static_cast<float>(v), 1.0F)
                           .cast<double>();
      const Vec3 unit = ray.normalized();
      double z = u >= occluder_u ? head_z - 0.6 : depth_at(cones, unit, head_z - 1.2, head_z + 1.5);
      PixelLabel label = PixelLabel::kPerson;
      if (u >= occluder_u || z <= 0.0) label = PixelLabel::kOther;
      if (z <= 0.0) z = head_z + 2.0;
      image.depth_m.push_back(static_cast<float>(z));
      image.labels.push_back(label);
      if (label == PixelLabel::kPerson) segment.points_m.push_back((ray * z).cast<float>());
    }
  }
  segment.range_image = image;
  const Vec3 head = body.points[refined::kHead];
  segment.seed_m = (head - 0.09 * head.normalized()).cast<float>();
  return segment;
}

Segment colored(Segment segment) {
  segment.range_image->is_skin.assign(segment.range_image->depth_m.size(), 0);
  return segment;
}

ImagePose in_image(const refined::BodyState& body, ImageNetwork network) {
  ImagePose pose{1.0F, {}};
  const float hips_z_m = static_cast<float>(body.points[index(Joint::kPelvis)].z());
  for (int joint = 0; joint < kJointCount; ++joint) {
    const Eigen::Vector3f place_m = refined::marked_place(body, joint, network).cast<float>();
    pose.joints.push_back(
        {static_cast<Joint>(joint), camera().project(place_m), 1.0F, place_m.z() - hips_z_m});
  }
  return pose;
}

std::vector<ImagePose> in_depths(const refined::BodyState& body) {
  std::vector<ImagePose> poses(kImageNetworkCount);
  poses.back() = in_image(body, ImageNetwork::kDepthPose);
  return poses;
}

}  // namespace limbcast::pose_fitter::testing
