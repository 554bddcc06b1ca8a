#include "modules/segmenter/floating_arms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "modules/segmenter/surfaces.hpp"

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

  std::int16_t nearest_person(const std::vector<std::uint32_t>& points) const {
    std::int16_t person = kNobody;
    float nearest_m = params_.max_from_person_m;
    const std::size_t step = std::max<std::size_t>(1, points.size() / kPointsCompared);
    for (std::size_t k = 0; k < points.size(); k += step) {
      visit_near(points[k], nearest_m, [&](std::uint32_t n, float distance2_m2) {
        if (people_.labels[n] < 0 || distance2_m2 >= nearest_m * nearest_m) return;
        nearest_m = std::sqrt(distance2_m2);
        person = people_.labels[n];
      });
    }
    return person;
  }

  bool arm_reaches(const HeadCandidate& head, const std::vector<std::uint32_t>& points) const {
    return std::all_of(points.begin(), points.end(), [&](std::uint32_t i) {
      const Eigen::Vector3f from_head_m = lattice_.level_m[i] - head.center_m;
      return from_head_m.norm() <= params_.max_head_distance_m &&
             -from_head_m.z() <= params_.max_below_head_m;
    });
  }

  /// Whether nothing else of nobody's is near, as the rest of a piece of furniture would be.
  bool stands_clear(const std::vector<std::uint32_t>& points) const {
    const std::int32_t own = surfaces_.of_point[points.front()];
    bool clear = true;
    for (std::size_t k = 0; clear && k < points.size(); ++k) {
      visit_near(points[k], params_.min_gap_m, [&](std::uint32_t n, float) {
        const std::int32_t other = surfaces_.of_point[n];
        if (other >= 0 && other != own) clear = false;
      });
    }
    return clear;
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
