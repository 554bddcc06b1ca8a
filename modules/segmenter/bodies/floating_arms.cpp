#include "modules/segmenter/bodies/floating_arms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "modules/segmenter/scene/surfaces.hpp"

namespace limbcast::segmenter {
namespace {

/// Points of a surface that are compared with people's: 3 cm apart on the largest arm.
constexpr std::size_t kPointsCompared = 128;

/// Tells whose arm a surface is.
class ArmOwner {
 public:
  ArmOwner(const Lattice& lattice, const Surfaces& surfaces, const FloatingArmParams& params,
           const FoundPeople& people)
      : lattice_(lattice), surfaces_(surfaces), params_(params), people_(people) {}

  /// kNobody of a surface that is no floating arm.
  std::int16_t find(const std::vector<std::uint32_t>& points) const {
    // Most surfaces are out of everybody's reach, and that is told in less time than who is near.
    if (std::none_of(people_.heads.begin(), people_.heads.end(),
                     [&](const HeadCandidate& head) { return arm_reaches(head, points); }))
      return kNobody;
    const std::int16_t person = nearest_person(points);
    if (person == kNobody || !arm_reaches(people_.heads[static_cast<std::size_t>(person)], points))
      return kNobody;
    return stands_clear(points) ? person : kNobody;
  }

 private:
  /// Calls `visit(n, distance2_m2)` of each point nearer to point `i` than the radius.
  template <typename Visit>
  void visit_near(std::uint32_t i, float radius_m, const Visit& visit) const {
    const Eigen::Vector3f& center_m = lattice_.level_m[i];
    const int reach_px =
        static_cast<int>(std::ceil(radius_m * lattice_.focal_px / lattice_.depth_m[i]));
    const int u = static_cast<int>(i) % lattice_.width, v = static_cast<int>(i) / lattice_.width;
    for (int dv = -reach_px; dv <= reach_px; ++dv) {
      for (int du = -reach_px; du <= reach_px; ++du) {
        const auto n = lattice_.find(u + du, v + dv);
        if (!n) continue;
        const float distance2_m2 = (lattice_.level_m[*n] - center_m).squaredNorm();
        if (distance2_m2 < radius_m * radius_m) visit(*n, distance2_m2);
      }
    }
  }

  /// How far each person's nearest point is from the surface [m], up to a limit.
  std::vector<float> distances_m(const std::vector<std::uint32_t>& points, float limit_m) const {
    std::vector<float> nearest_m(people_.heads.size(), limit_m);
    const std::size_t step = std::max<std::size_t>(1, points.size() / kPointsCompared);
    for (std::size_t k = 0; k < points.size(); k += step) {
      visit_near(points[k], limit_m, [&](std::uint32_t n, float distance2_m2) {
        if (people_.labels[n] < 0) return;
        float& known_m = nearest_m[static_cast<std::size_t>(people_.labels[n])];
        known_m = std::min(known_m, std::sqrt(distance2_m2));
      });
    }
    return nearest_m;
  }

  std::int16_t nearest_person(const std::vector<std::uint32_t>& points) const {
    const float limit_m = std::max(params_.max_from_person_m, params_.max_from_rival_m);
    std::vector<float> nearest_m = distances_m(points, limit_m);
    const auto person = std::min_element(nearest_m.begin(), nearest_m.end());
    if (*person >= params_.max_from_person_m) return kNobody;
    *person = limit_m;
    const float rival_m = *std::min_element(nearest_m.begin(), nearest_m.end());
    return rival_m < params_.max_from_rival_m
               ? kNobody
               : static_cast<std::int16_t>(person - nearest_m.begin());
  }

  bool arm_reaches(const HeadCandidate& head, const std::vector<std::uint32_t>& points) const {
    return std::all_of(points.begin(), points.end(), [&](std::uint32_t i) {
      const Eigen::Vector3f from_head_m = lattice_.level_m[i] - head.center_m;
      return from_head_m.norm() <= params_.max_head_distance_m &&
             -from_head_m.z() <= params_.max_below_head_m;
    });
  }

  /// Whether nothing else of nobody's is near that is larger than a stray return, as the rest of a
  /// piece of furniture would be.
  bool stands_clear(const std::vector<std::uint32_t>& points) const {
    const std::int32_t own = surfaces_.of_point[points.front()];
    bool clear = true;
    for (std::size_t k = 0; clear && k < points.size(); ++k) {
      visit_near(points[k], params_.min_gap_m, [&](std::uint32_t n, float) {
        const std::int32_t other = surfaces_.of_point[n];
        if (other >= 0 && other != own && area_m2(other) >= params_.min_other_m2) clear = false;
      });
    }
    return clear;
  }

  float area_m2(std::int32_t surface) const {
    return surfaces_.all[static_cast<std::size_t>(surface)].area_m2;
  }

  const Lattice& lattice_;
  const Surfaces& surfaces_;
  const FloatingArmParams& params_;
  const FoundPeople& people_;
};

}  // namespace

void add_floating_arms(const Lattice& lattice, const FloatingArmParams& params,
                       FoundPeople& people) {
  if (people.heads.empty()) return;
  // What the depths leave unsure may be an arm.
  std::vector<std::int16_t> taken = people.labels;
  std::replace(taken.begin(), taken.end(), kUnsure, kNobody);
  const Surfaces surfaces = find_surfaces(lattice, params.surface, &taken);
  const std::vector<std::vector<std::uint32_t>> points = points_by_surface(surfaces);
  const ArmOwner owner(lattice, surfaces, params, people);
  std::vector<std::int16_t> owners;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const float area_m2 = surfaces.all[k].area_m2;
    const bool arm_sized = area_m2 >= params.min_area_m2 && area_m2 <= params.max_area_m2;
    owners.push_back(arm_sized ? owner.find(points[k]) : kNobody);
  }
  // Not before all are told: an arm is nobody's way to the next one.
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (owners[k] == kNobody) continue;
    for (const std::uint32_t i : points[k]) people.labels[i] = owners[k];
  }
}

}  // namespace limbcast::segmenter
