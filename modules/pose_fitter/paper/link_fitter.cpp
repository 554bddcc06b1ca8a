#include "modules/pose_fitter/paper/link_fitter.hpp"

#include <cmath>
#include <limits>

namespace limbcast::pose_fitter {
namespace {

using Eigen::Vector3f;

float cosine_of_deg(double degrees) {
  return static_cast<float>(std::cos(degrees * 3.14159265358979323846 / 180.0));
}

}  // namespace

LinkFitter::LinkFitter(const Cluster& cluster, const PaperFitterParams& params)
    : cluster_(cluster),
      params_(params),
      min_turn_cosine_(cosine_of_deg(params.max_link_turn_deg)),
      min_bend_cosine_(cosine_of_deg(params.max_bend_deg)) {}

LinkFit LinkFitter::find_best_fit(const Link& link, const LinkStart& start,
                                  const Vector3f& direction) const {
  const auto length = static_cast<float>(link.length_m);
  const auto min_length = static_cast<float>(link.min_length_m);
  const auto max_length = static_cast<float>(link.max_length_m);
  const auto radius = static_cast<float>(params_.near_radius_m);
  const auto dense = static_cast<float>(params_.dense_points);
  const Vector3f reference = start.position_m + direction * length;

  LinkFit best;
  float best_error = std::numeric_limits<float>::max();
  cluster_.visit_near(reference, radius, [&](int index) {
    const Vector3f& end = cluster_.point(index);
    const Vector3f along = end - start.position_m;
    const float found_length = along.norm();
    if (found_length < min_length || found_length > max_length) return;
    const float turn_cosine = along.dot(direction) / found_length;
    if (turn_cosine < min_turn_cosine_) return;
    if (along.dot(start.parent_direction) < min_bend_cosine_ * found_length) return;
    const float distance = (end - reference).norm();
    const float restrictions =
        static_cast<float>(params_.length_weight) * std::abs(found_length / length - 1.0F) +
        static_cast<float>(params_.direction_weight) * (1.0F - turn_cosine) +
        static_cast<float>(params_.distance_weight) * distance / radius;
    // The density can only add to it; most points end here.
    if (restrictions >= best_error) return;
    const LinkDensity density = cluster_.density(start.position_m, end);
    if (density.min < static_cast<float>(params_.min_points_along_link)) return;
    const float error = 1.0F - density.mean / dense + restrictions;
    if (error >= best_error) return;
    best_error = error;
    best = {true, end, distance, density.mean};
  });
  return best;
}

}  // namespace limbcast::pose_fitter
