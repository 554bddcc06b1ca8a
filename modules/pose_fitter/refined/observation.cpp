#include "modules/pose_fitter/refined/observation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core/fast_math.hpp>

#include "common/cloud/head_depth.hpp"
#include "modules/pose_fitter/refined/chamfer_distance.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Error of a head's centre that was seen, and of one guessed from the body beneath it [m].
constexpr Real kSeenHeadSigmaM = 0.05, kGuessedHeadSigmaM = 0.20;
/// An own pixel farther than this in depth from the head is an error of the segmentation [m].
constexpr float kMaxDepthFromHeadM = 1.1F;
/// What is this much nearer than the person's median hides what may be behind it [m].
constexpr float kOccluderGapM = 0.25F;
/// Half width of the window that averages noisy depth [px], and how far a neighbour may be
/// [sigmas].
constexpr int kSmoothingRadiusPx = 3;
constexpr float kSmoothingSigmas = 3.5F;
/// Border kept around the person's pixels [px].
constexpr int kMarginPx = 40;
/// Points weigh by the area they stand for, in squares of this side [m].
constexpr float kWeightSideM = 0.03F;

/// Virtual camera for points without a range image.
constexpr double kVirtualFocalPx = 150.0;

/// Range image of the points alone: what lies beside them is unknown.
RangeImage rendered(const Segment& segment) {
  RangeImage image;
  Eigen::Vector3f forward = segment.seed_m.normalized();
  const Eigen::Vector3f right = Eigen::Vector3f(0, 1, 0).cross(forward).normalized();
  image.frame_from_image << right, forward.cross(right), forward;
  PinholeCamera& camera = image.camera;
  camera.width = camera.height = image.full_width = image.full_height =
      static_cast<int>(2.0 * kVirtualFocalPx);
  camera.fx = camera.fy = kVirtualFocalPx;
  camera.cx = camera.cy = kVirtualFocalPx;
  const std::size_t pixels = static_cast<std::size_t>(camera.width) * camera.height;
  image.depth_m.assign(pixels, 0.0F);
  image.labels.assign(pixels, PixelLabel::kUnknown);
  for (const Eigen::Vector3f& point : segment.points_m) {
    const Eigen::Vector3f p = image.frame_from_image.transpose() * point;
    if (p.z() < 0.1F) continue;
    const Eigen::Vector2f pixel = camera.project(p);
    const int u = static_cast<int>(std::lround(pixel.x())),
              v = static_cast<int>(std::lround(pixel.y()));
    if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) continue;
    const std::size_t i = static_cast<std::size_t>(v) * camera.width + u;
    if (image.depth_m[i] > 0.0F && image.depth_m[i] < p.z()) continue;
    image.depth_m[i] = p.z();
    image.labels[i] = PixelLabel::kPerson;
  }
  return image;
}

struct Box {
  int u0, v0, u1, v1;
};

/// Box of the person's pixels and the median of their depth; nothing when they are too few.
std::optional<Box> person_box(const RangeImage& image, float head_z, int min_points,
                              float& median_z) {
  Box box{image.camera.width, image.camera.height, -1, -1};
  std::vector<float> depths;
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      const std::size_t i = static_cast<std::size_t>(v) * image.camera.width + u;
      if (image.labels[i] != PixelLabel::kPerson) continue;
      box = {std::min(box.u0, u), std::min(box.v0, v), std::max(box.u1, u), std::max(box.v1, v)};
      const float z = image.depth_m[i];
      if (z > 0.0F && std::abs(z - head_z) < kMaxDepthFromHeadM) depths.push_back(z);
    }
  }
  if (static_cast<int>(depths.size()) < min_points) return std::nullopt;
  std::nth_element(depths.begin(), depths.begin() + depths.size() / 2, depths.end());
  median_z = depths[depths.size() / 2];
  return box;
}

/// Fills clearance and surface on the person's box with a margin.
void make_grids(const RangeImage& image, const Box& box, float head_z, float median_z,
                Observation& observation) {
  PinholeCamera& camera = observation.camera;
  const int u0 = box.u0 - kMarginPx, v0 = box.v0 - kMarginPx;
  camera = image.camera;
  camera.width = box.u1 - box.u0 + 1 + 2 * kMarginPx;
  camera.height = box.v1 - box.v0 + 1 + 2 * kMarginPx;
  camera.cx -= u0;
  camera.cy -= v0;
  observation.origin_u = image.origin_u + u0;
  observation.origin_v = image.origin_v + v0;
  observation.full_width = image.full_width;
  observation.full_height = image.full_height;
  std::vector<std::uint8_t> may_stand;
  may_stand.reserve(static_cast<std::size_t>(camera.width) * camera.height);
  observation.surface_m.assign(static_cast<std::size_t>(camera.width) * camera.height, 0.0F);
  observation.seen_m = observation.measured_m = observation.surface_m;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      std::uint8_t free = 1;
      const int iu = u + u0, iv = v + v0;
      if (observation.in_sensor_image(u, v) && iu >= 0 && iv >= 0 && iu < image.camera.width &&
          iv < image.camera.height) {
        const std::size_t i = static_cast<std::size_t>(iv) * image.camera.width + iu;
        const float z = image.depth_m[i];
        if (image.labels[i] != PixelLabel::kUnknown)
          observation.measured_m[observation.at(u, v)] = z;
        if (image.labels[i] == PixelLabel::kOther) {
          free = z < median_z - kOccluderGapM;
          if (free) observation.seen_m[observation.at(u, v)] = z;
        } else if (image.labels[i] == PixelLabel::kPerson &&
                   std::abs(z - head_z) < kMaxDepthFromHeadM) {
          observation.surface_m[observation.at(u, v)] = z;
          observation.seen_m[observation.at(u, v)] = z;
        }
      }
      may_stand.push_back(free);
    }
  }
  observation.clearance_px = chamfer_distance(may_stand, camera.width, camera.height);
  for (std::uint8_t& free : may_stand) free = 1 - free;
  const std::vector<float> outwards = chamfer_distance(may_stand, camera.width, camera.height);
  for (std::size_t i = 0; i < outwards.size(); ++i) observation.clearance_px[i] -= outwards[i];
}

/// Face and bare hands show some skin; fewer pixels tell of none.
void find_skin(const RangeImage& image, const Box& box, Observation& observation) {
  constexpr int kLeastPixels = 20;
  if (image.is_skin.empty()) return;
  const PinholeCamera& camera = observation.camera;
  std::vector<std::uint8_t> no_skin(observation.surface_m.size(), 1);
  int count = 0;
  for (int v = kMarginPx; v < camera.height - kMarginPx; ++v) {
    for (int u = kMarginPx; u < camera.width - kMarginPx; ++u) {
      const std::size_t i = static_cast<std::size_t>(v + box.v0 - kMarginPx) * image.camera.width +
                            u + box.u0 - kMarginPx;
      if (image.is_skin[i] == 0 || observation.surface_m[observation.at(u, v)] <= 0.0F) continue;
      no_skin[observation.at(u, v)] = 0;
      ++count;
    }
  }
  if (count < kLeastPixels) return;
  observation.skin_distance_px = chamfer_distance(no_skin, camera.width, camera.height);
}

/// How far apart a network marks the joints of both sides, at a distance.
Real apart_m(const ImageLook& look, int left_joint, Real distance_m) {
  return distance_m * look.joints[left_joint].ray.cross(look.joints[left_joint + 1].ray).norm();
}

/// Somebody's seen arm, marked for the hidden one too by a network that tells of arms in sight,
/// says nothing of where that one is.
void leave_out_one_arm_marked_twice(Real distance_m, const RefinedParams& params, ImageLook& look) {
  if (apart_m(look, kElbow, distance_m) > params.image_one_arm_m ||
      apart_m(look, kWrist, distance_m) > params.image_one_arm_m)
    return;
  for (int joint = kElbow; joint < kHip; ++joint) look.joints[joint].visibility = 0.0;
}

/// How unsure the place of a mark is, against a usual one.
Real relative_spread(const ImageJoint& joint, const RefinedParams& params) {
  if (joint.spread_m == 0.0F) return 1.0;  // the network does not tell
  const Real spread_m = std::max<Real>(joint.spread_m, params.least_mark_spread_m);
  return std::pow(spread_m / params.usual_mark_spread_m, params.mark_spread_exponent);
}

/// What the network of depths takes for hidden it guesses; colours may show it elsewhere.
void doubt_what_is_seen_elsewhere(const std::vector<ImageLook>& others, Real distance_m,
                                  const RefinedParams& params, ImageLook& look) {
  for (std::size_t joint = 0; joint < look.joints.size(); ++joint) {
    SeenJoint& mark = look.joints[joint];
    Real seen_elsewhere = 0.0;
    for (const ImageLook& other : others) {
      const SeenJoint& seen = other.joints[joint];
      if (distance_m * seen.ray.cross(mark.ray).norm() > params.image_elsewhere_m)
        seen_elsewhere = std::max(seen_elsewhere, seen.visibility);
    }
    mark.visibility *=
        1.0 - params.image_elsewhere_doubt * (1.0 - mark.told_visibility) * seen_elsewhere;
  }
}

void set_looks(const Segment& segment, const RangeImage& image, const RefinedParams& params,
               Observation& observation) {
  observation.has_colors = !image.is_skin.empty();
  const Eigen::Vector2f origin_px(static_cast<float>(image.origin_u),
                                  static_cast<float>(image.origin_v));
  for (std::size_t network = 0; network < segment.image_poses.size(); ++network) {
    const ImagePose& pose = segment.image_poses[network];
    if (pose.joints.empty()) continue;
    ImageLook look;
    look.network = static_cast<ImageNetwork>(network);
    look.weight = params.image_weight.at(network);
    look.depth_weight = params.image_depth_weight.at(network);
    look.person_score = pose.person_score;
    const Real exponent = params.image_visibility_exponent.at(network);
    for (const ImageJoint& joint : pose.joints) {
      const Eigen::Vector2f px = joint.px - origin_px;
      look.joints[index(joint.joint)] = {
          image.camera.back_project(px.x(), px.y(), 1.0F).cast<Real>().normalized(),
          std::pow(joint.visibility, exponent), joint.behind_hips_m, joint.visibility,
          relative_spread(joint, params)};
    }
    const Real distance_m = observation.head_start.norm();
    if (look.network == ImageNetwork::kDepthPose) {
      doubt_what_is_seen_elsewhere(observation.looks, distance_m, params, look);
    } else {
      leave_out_one_arm_marked_twice(distance_m, params, look);
    }
    observation.looks.push_back(look);
  }
}

PointColumns sampled(const Observation& observation, int step, const RefinedParams& params) {
  PointColumns points;
  const auto square_weight = static_cast<float>(
      observation.noise.grows_with_distance() ? params.point_weight : params.scan_point_weight);
  const PinholeCamera& camera = observation.camera;
  for (int v = 0; v < camera.height; v += step) {
    for (int u = 0; u < camera.width; u += step) {
      const float z = observation.smooth_surface_m(u, v);
      if (z <= 0.0F) continue;
      const Vec3 point =
          camera.back_project(static_cast<float>(u), static_cast<float>(v), z).cast<Real>();
      if ((point - observation.head_start).norm() > params.reach_m) continue;
      const float side =
          z / static_cast<float>(camera.fx) * static_cast<float>(step) / kWeightSideM;
      points.add(point, square_weight * side * side, observation.noise.sigma_m(z));
    }
  }
  points.pad();
  return points;
}

}  // namespace

void PointColumns::add(const Vec3& point, float point_weight, float point_sigma_m) {
  x.push_back(static_cast<float>(point.x()));
  y.push_back(static_cast<float>(point.y()));
  z.push_back(static_cast<float>(point.z()));
  weight.push_back(point_weight);
  sigma_m.push_back(point_sigma_m);
}

float Observation::smooth_surface_m(int u, int v) const {
  const float z = surface_m[at(u, v)];
  if (z <= 0.0F || !noise.grows_with_distance()) return z;
  const float limit = kSmoothingSigmas * noise.sigma_m(z);
  float sum = 0.0F;
  int count = 0;
  for (int y = std::max(0, v - kSmoothingRadiusPx);
       y <= std::min(camera.height - 1, v + kSmoothingRadiusPx); ++y) {
    for (int x = std::max(0, u - kSmoothingRadiusPx);
         x <= std::min(camera.width - 1, u + kSmoothingRadiusPx); ++x) {
      const float other = surface_m[at(x, y)];
      if (other <= 0.0F || std::abs(other - z) > limit) continue;
      sum += other;
      ++count;
    }
  }
  return sum / static_cast<float>(count);
}

float Observation::smooth_surface_m(const SeenJoint& seen) const {
  const Eigen::Vector2f px = camera.project(seen.ray.cast<float>());
  const int u = cvRound(px.x()), v = cvRound(px.y());
  return inside(u, v) ? smooth_surface_m(u, v) : 0.0F;
}

void PointColumns::pad() {
  for (std::vector<float>* column : {&x, &y, &z}) column->resize((size() + 7) / 8 * 8, 0.0F);
}

std::optional<Observation> observe(const Segment& segment, const Stamp& stamp,
                                   const RefinedParams& params) {
  if (!segment.range_image && static_cast<int>(segment.points_m.size()) < params.min_points) {
    return std::nullopt;
  }
  const RangeImage& image = segment.range_image ? *segment.range_image : rendered(segment);
  Observation observation;
  observation.frame_from_image = image.frame_from_image;
  observation.noise = stamp.depth_noise;
  const Vec3 seed = (image.frame_from_image.transpose() * segment.seed_m).cast<Real>();
  if (!(seed.norm() > 0.1)) return std::nullopt;
  observation.head_start = seed + kHeadBehindSeed_m * seed.normalized();
  observation.guessed_head = segment.seed_kind == SeedKind::kBody;
  observation.head_start_sigma_m = observation.guessed_head ? kGuessedHeadSigmaM : kSeenHeadSigmaM;
  observation.up = -(image.frame_from_image.transpose() * stamp.gravity.down).cast<Real>();
  observation.face = segment.face;
  if (stamp.gravity.sensor_height_m) observation.floor_m = *stamp.gravity.sensor_height_m;

  float median_z = 0.0F;
  const float head_z = static_cast<float>(seed.z());
  const std::optional<Box> box = person_box(image, head_z, params.min_points, median_z);
  if (!box) return std::nullopt;
  make_grids(image, *box, head_z, median_z, observation);
  find_skin(image, *box, observation);
  set_looks(segment, image, params, observation);
  const auto own_pixels = std::count_if(observation.surface_m.begin(), observation.surface_m.end(),
                                        [](float z) { return z > 0.0F; });
  const int step = std::max(1, static_cast<int>(std::lround(std::sqrt(
                                   static_cast<double>(own_pixels) / params.target_points))));
  observation.fine = sampled(observation, step, params);
  observation.coarse = sampled(observation, 2 * step, params);
  if (static_cast<int>(observation.fine.size()) < params.min_points) return std::nullopt;
  return observation;
}

}  // namespace limbcast::pose_fitter::refined
