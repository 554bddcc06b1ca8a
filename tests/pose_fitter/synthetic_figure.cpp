#include "tests/pose_fitter/synthetic_figure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/pose_fitter/paper/rotation_fitter.hpp"

namespace limbcast::pose_fitter {
namespace {

using Eigen::Vector3f;

constexpr float kSpacingM = 0.012F;

struct Capsule {
  Vector3f from, to;
  float radius_m;

  float distance(const Vector3f& point) const {
    const Vector3f line = to - from;
    const float along =
        std::clamp((point - from).dot(line) / std::max(line.squaredNorm(), 1e-9F), 0.0F, 1.0F);
    return (point - from - along * line).norm() - radius_m;
  }
};

/// Rays of a pixel lattice are followed until they meet a capsule (sphere tracing).
void add_visible_points(const std::vector<Capsule>& capsules, const std::vector<bool>& is_left_out,
                        const Vector3f& middle, std::vector<Vector3f>& points) {
  const float step = kSpacingM / middle.z();
  const int reach = static_cast<int>(1.3F / kSpacingM);
  for (int v = -reach; v <= reach; ++v) {
    for (int u = -reach; u <= reach; ++u) {
      const Vector3f ray = (middle / middle.z() +
                            step * Vector3f(static_cast<float>(u), static_cast<float>(v), 0.0F))
                               .normalized();
      float t = middle.norm() - 1.5F;
      for (int i = 0; i < 60 && t < middle.norm() + 1.5F; ++i) {
        float nearest = 10.0F;
        std::size_t which = 0;
        for (std::size_t k = 0; k < capsules.size(); ++k) {
          const float distance = capsules[k].distance(t * ray);
          if (distance < nearest) {
            nearest = distance;
            which = k;
          }
        }
        if (nearest < 1e-3F) {
          if (!is_left_out[which]) points.push_back(t * ray);
          break;
        }
        t += nearest;
      }
    }
  }
}

}  // namespace

Figure make_figure(const HumanModel& model, int typical_pose, const FigureOptions& options) {
  Figure figure;
  figure.stamp.gravity.down = Vector3f(0.0F, 1.0F, 0.0F);
  const Eigen::Matrix3f axes =
      body_axes(options.head_m, figure.stamp.gravity.down, options.rotation_rad);
  std::array<Vector3f, kLinkCount> ends;
  ends[0] = options.head_m;
  std::vector<Capsule> capsules = {{ends[0], ends[0], 0.09F}};
  std::vector<bool> left_out = {false};
  for (int number = 1; number < kLinkCount; ++number) {
    const Link& link = model.links[number];
    ends[number] =
        ends[link.connected_to] + axes * model.typical_poses[typical_pose].directions[number] *
                                      static_cast<float>(link.length_m * options.scale);
    const bool limb = number >= 4 && (number <= 7 || number >= 12);
    const float radius_m = limb ? static_cast<float>(link.depth_offset_m) + 0.01F : 0.11F;
    capsules.push_back({ends[link.connected_to], ends[number],
                        static_cast<float>(options.scale) * (number == 1 ? 0.06F : radius_m)});
    left_out.push_back(options.without[number]);
    figure.skeleton.set(link.end, ends[number]);
  }
  figure.skeleton.set(Joint::kHead, ends[0]);
  add_visible_points(capsules, left_out, options.head_m + Vector3f(0.0F, 0.8F, 0.0F),
                     figure.segment.points_m);
  figure.segment.seed_m = options.head_m * (1.0F - 0.09F / options.head_m.norm());
  return figure;
}

float joint_error_m(const BodyPose& body, const Figure& figure, Joint joint) {
  return (body[joint].position_m - figure.skeleton[joint]).norm();
}

}  // namespace limbcast::pose_fitter
