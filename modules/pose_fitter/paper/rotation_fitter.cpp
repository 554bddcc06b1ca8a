#include "modules/pose_fitter/paper/rotation_fitter.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "common/shortest_turn.hpp"

namespace limbcast::pose_fitter {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

int count_bits(const std::vector<std::uint64_t>& bits) {
  int count = 0;
  for (const std::uint64_t word : bits) count += __builtin_popcountll(word);
  return count;
}

}  // namespace

Matrix3f body_axes(const Vector3f& head_m, const Vector3f& down, double rotation_rad) {
  const Vector3f up = -down.normalized();
  Vector3f forward = -head_m - up * up.dot(-head_m);
  // Straight below or above the sensor any direction is as good.
  if (forward.norm() < 1e-3F) forward = up.unitOrthogonal();
  forward = Eigen::AngleAxisf(static_cast<float>(rotation_rad), up) * forward.normalized();
  Matrix3f axes;
  axes << up.cross(forward), up, forward;
  return axes;
}

RotationFitter::RotationFitter(const HumanModel& model, const PaperFitterParams& params,
                               const Cluster& cluster, const Vector3f& head_m, const Matrix3f& axes)
    : model_(model),
      params_(params),
      cluster_(cluster),
      link_fitter_(cluster, params),
      head_m_(head_m),
      axes_(axes) {}

FittedPose RotationFitter::fit(int typical_pose) {
  FittedPose pose;
  pose.typical_pose = typical_pose;
  pose.links[0] = {true, head_m_, 0.0F, 0.0F};
  std::vector<std::uint64_t> used((cluster_.size() + 63) / 64, 0);
  for (int number = 1; number < kLinkCount; ++number) {
    const Link& link = model_.links[number];
    const LinkFit& parent = pose.links[link.connected_to];
    if (!parent.valid) continue;  // left out with what it hangs on
    LinkStart start{parent.end_m, Vector3f::Zero()};
    if (link.connected_to != 0) {
      const int before = model_.links[link.connected_to].connected_to;
      start.parent_direction = (parent.end_m - pose.links[before].end_m).normalized();
    }
    const SharedFit& found = shared_fit(number, start, reference_direction(number, pose));
    pose.links[number] = found.fit;
    for (std::size_t i = 0; i < found.near_points.size(); ++i) used[i] |= found.near_points[i];
  }
  compute_error(used, pose);
  return pose;
}

Vector3f RotationFitter::reference_direction(int number, const FittedPose& pose) const {
  const auto& directions = model_.typical_poses[pose.typical_pose].directions;
  const Vector3f own = axes_ * directions[number];
  const auto& coupled_to = model_.links[number].coupled_to;
  if (!coupled_to || !pose.links[*coupled_to].valid) return own;
  // The other side moved away from its reference; this one is expected to follow.
  const Vector3f other = axes_ * directions[*coupled_to];
  const Vector3f other_found =
      (pose.links[*coupled_to].end_m - pose.links[model_.links[*coupled_to].connected_to].end_m)
          .normalized();
  return shortest_turn(other, other_found) * own;
}

const RotationFitter::SharedFit& RotationFitter::shared_fit(int number, const LinkStart& start,
                                                            const Vector3f& direction) {
  std::vector<SharedFit>& known = shared_[number];
  const auto same = [&](const SharedFit& other) {
    return other.direction == direction && other.start.position_m == start.position_m &&
           other.start.parent_direction == start.parent_direction;
  };
  const auto found = std::find_if(known.begin(), known.end(), same);
  if (found != known.end()) return *found;
  const Link& link = model_.links[number];
  SharedFit shared{start, direction, link_fitter_.find_best_fit(link, start, direction), {}};
  if (shared.fit.valid) {
    cluster_.mark_near_line(start.position_m, shared.fit.end_m, static_cast<float>(link.radius_m),
                            shared.near_points);
  }
  known.push_back(std::move(shared));
  return known.back();
}

void RotationFitter::compute_error(const std::vector<std::uint64_t>& used, FittedPose& pose) const {
  double distance_m = 0.0, missing = 0.0, low_density = 0.0;
  for (int number = 1; number < kLinkCount; ++number) {
    const LinkFit& fit = pose.links[number];
    if (!fit.valid) {
      missing += model_.links[number].has_children ? params_.missing_inner_penalty
                                                   : params_.missing_outer_penalty;
      continue;
    }
    distance_m += fit.distance_m;
    low_density += fit.mean_density < params_.low_density_points ? 1.0 : 0.0;
  }
  const double used_share = count_bits(used) / static_cast<double>(cluster_.size());
  pose.terms = {static_cast<float>(params_.alpha_distance * distance_m),
                static_cast<float>(params_.alpha_missing * missing),
                static_cast<float>(params_.alpha_unused * (1.0 - used_share)),
                static_cast<float>(params_.alpha_density * low_density)};
  pose.error = pose.terms[0] + pose.terms[1] + pose.terms[2] + pose.terms[3];
}

}  // namespace limbcast::pose_fitter
