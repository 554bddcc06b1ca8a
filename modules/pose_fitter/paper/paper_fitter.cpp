#include "modules/pose_fitter/paper/paper_fitter.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "modules/pose_fitter/paper/cluster.hpp"
#include "modules/pose_fitter/paper/rotation_fitter.hpp"
#include "modules/pose_fitter/paper/skeleton.hpp"
#include "modules/pose_fitter/paper/validity.hpp"
#include "modules/pose_fitter/pointing.hpp"

namespace limbcast::pose_fitter {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;

Vector3f moved_along_ray(const Vector3f& point, double distance_m) {
  return point * (1.0F + static_cast<float>(distance_m) / std::max(point.norm(), 1e-3F));
}

/// Every typical pose in every rotation; one task a rotation, as they share nothing.
std::vector<FittedPose> fit_all(const HumanModel& model, const PaperFitterParams& params,
                                const Cluster& cluster, const Vector3f& head_m,
                                const std::vector<Matrix3f>& axes) {
  const int pose_count = static_cast<int>(model.typical_poses.size());
  std::vector<FittedPose> poses(axes.size() * pose_count);
  tbb::parallel_for(0, static_cast<int>(axes.size()), [&](int rotation) {
    RotationFitter fitter(model, params, cluster, head_m, axes[rotation]);
    for (int i = 0; i < pose_count; ++i) {
      FittedPose& pose = poses[rotation * pose_count + i];
      pose = fitter.fit(i);
      pose.rotation = rotation;
    }
  });
  return poses;
}

/// The valid pose of lowest error; of equal ones the first.
std::optional<FittedPose> best_valid(const std::vector<FittedPose>& poses, const HumanModel& model,
                                     const std::vector<Matrix3f>& axes,
                                     const PaperFitterParams& params) {
  std::vector<const FittedPose*> ranked;
  for (const FittedPose& pose : poses) ranked.push_back(&pose);
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto* a, const auto* b) { return a->error < b->error; });
  const auto found = std::find_if(ranked.begin(), ranked.end(), [&](const FittedPose* pose) {
    return is_valid(*pose, model, axes[pose->rotation], params);
  });
  if (found == ranked.end()) return std::nullopt;
  return **found;
}

float eq2_scale(const FittedPose& pose, const HumanModel& model, const PaperFitterParams& params) {
  return average_scale(link_scales(pose, model), params.scale_average);
}

/// The winner, and the lengths with which it was found.
struct Winner {
  FittedPose pose;
  double scale;
};

/// Fits with the model's start scale, then again with what Eq. 2 says the person's is.
std::optional<Winner> fit_person(const HumanModel& model, const PaperFitterParams& params,
                                 const Cluster& cluster, const Vector3f& head_m,
                                 const std::vector<Matrix3f>& axes) {
  std::optional<Winner> winner;
  double scale = model.start_scale;
  for (int pass = 0; pass < params.max_passes; ++pass) {
    const HumanModel sized = scaled(model, scale);
    const auto best =
        best_valid(fit_all(sized, params, cluster, head_m, axes), sized, axes, params);
    if (!best) break;
    if (!winner || best->error < winner->pose.error) winner = Winner{*best, scale};
    const double change = eq2_scale(*best, sized, params);
    if (std::abs(change - 1.0) <= params.rescale_above) break;
    scale *= change;
  }
  return winner;
}

BodyPose to_body_pose(const FittedPose& fitted, const HumanModel& model, const Matrix3f& axes,
                      const PaperFitterParams& params) {
  BodyPose body;
  body.scale = eq2_scale(fitted, model, params);
  for (int number = 0; number < kLinkCount; ++number) {
    const Link& link = model.links[number];
    const LinkFit& fit = fitted.links[number];
    if (!fit.valid) continue;
    JointEstimate& joint = body[link.end];
    joint.valid = true;
    joint.position_m = moved_along_ray(fit.end_m, link.depth_offset_m - params.inward_m);
    joint.confidence = link.confidence;
    if (number == 0) continue;
    body.link_lengths_m[index(link.end)] =
        (fit.end_m - fitted.links[link.connected_to].end_m).norm();
  }
  const JointAngles angles = fitted_angles(fitted, model, axes);
  std::transform(angles.begin(), angles.end(), body.angles_rad.begin(),
                 [](const JointAngle& angle) { return angle.rad; });
  // Falls with Eq. 1, so that of two poses in one place the better one stays; not a measured share.
  body.confidence = 1.0F / (1.0F + fitted.error);
  body.error = fitted.error;
  body.error_terms = fitted.terms;
  body.typical_pose = fitted.typical_pose;
  body.rotation_deg = static_cast<float>(fitted.rotation * model.rotation_step_rad * kDegPerRad);
  return body;
}

}  // namespace

PaperFitter::PaperFitter(const PaperFitterParams& params)
    : params_(params), model_(load_human_model(params.model_files)) {}

std::optional<BodyPose> PaperFitter::fit(const Segment& segment, const Stamp& stamp) const {
  if (!segment.seed_m.allFinite()) return std::nullopt;
  const Cluster cluster(segment.points_m, segment.seed_m,
                        {params_.voxel_m, params_.inward_m, params_.reach_m, params_.dense_points});
  if (cluster.size() < params_.min_points) return std::nullopt;
  const Vector3f head_m = moved_along_ray(segment.seed_m, params_.inward_m);
  std::vector<Matrix3f> axes;
  for (int rotation = 0; rotation < model_.rotation_count; ++rotation) {
    axes.push_back(body_axes(head_m, stamp.gravity.down, rotation * model_.rotation_step_rad));
  }
  const auto winner = fit_person(model_, params_, cluster, head_m, axes);
  if (!winner) return std::nullopt;
  BodyPose body = to_body_pose(winner->pose, model_, axes[winner->pose.rotation], params_);
  body.id = segment.id;
  body.pointing = find_pointing(body, stamp.gravity.down, params_.pointing);
  return body;
}

}  // namespace limbcast::pose_fitter
