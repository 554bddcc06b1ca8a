#include "modules/simulate/laser.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace limbcast::simulate {
namespace {

using Eigen::Vector3f;

constexpr double kRadian = 3.14159265358979 / 180.0;

/// What a ring tells wrong.
struct RingError {
  double range_m = 0.0, azimuth_deg = 0.0;
};

std::vector<RingError> errors_of_rings(const LaserParams& params, Rng rng) {
  std::vector<RingError> errors(static_cast<std::size_t>(params.rings));
  for (RingError& error : errors) {
    error.range_m = rng.normal(0.0, params.ring_range_sigma_m);
    error.azimuth_deg = rng.normal(0.0, params.ring_azimuth_sigma_deg);
  }
  return errors;
}

/// `errors`: of each ring's azimuth.
RayGrid rays_of(const LaserParams& params, const std::vector<RingError>& errors) {
  RayGrid rays;
  rays.height = params.rings;
  rays.width = 1 + static_cast<int>(std::lround((params.max_azimuth_deg - params.min_azimuth_deg) /
                                                params.azimuth_step_deg));
  const double elevation_step =
      params.rings > 1 ? (params.max_elevation_deg - params.min_elevation_deg) / (params.rings - 1)
                       : 0.0;
  rays.direction = [params, elevation_step, errors](int u, int v) {
    const double azimuth = (params.min_azimuth_deg + u * params.azimuth_step_deg +
                            errors[static_cast<std::size_t>(v)].azimuth_deg) *
                           kRadian;
    const double elevation =
        (params.max_elevation_deg - v * elevation_step) * kRadian;  // rows from the top
    return Vector3f(static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
                    static_cast<float>(-std::sin(elevation)),
                    static_cast<float>(std::cos(elevation) * std::cos(azimuth)));
  };
  return rays;
}

float brightness(const Material& material) {
  return (0.1F * static_cast<float>(material.color.b) +
          0.6F * static_cast<float>(material.color.g) +
          0.3F * static_cast<float>(material.color.r)) *
         (100.0F / 255.0F);
}

}  // namespace

LaserScan scan(const World& world, const LaserParams& params, Rng rng) {
  constexpr std::uint64_t kRings = 1;
  const std::vector<RingError> errors = errors_of_rings(params, rng.derive(kRings));
  const RayGrid rays = rays_of(params, errors);
  const RayGrid told = rays_of(params, std::vector<RingError>(errors.size()));
  RaycastParams cast;
  cast.max_range_m = static_cast<float>(params.max_range_m);
  const HitImage hits = raycast(world, rays, cast);
  LaserScan result;
  for (int v = 0; v < rays.height; ++v) {
    for (int u = 0; u < rays.width; ++u) {
      const Hit& hit = hits.at(u, v);
      double range = hit.range_m + errors[static_cast<std::size_t>(v)].range_m +
                     rng.normal(0.0, params.range_sigma_m);
      const bool lost = rng.chance(params.lost_share);
      const double share = rng.uniform();
      // A beam that meets an edge with half its width tells something between front and back; it
      // does with the chance that the edge lies within its width.
      const Hit& next = hits.at(std::min(u + 1, rays.width - 1), v);
      const double edge_chance = 2.0 * params.edge_beam_rad / (params.azimuth_step_deg * kRadian);
      const bool edge =
          next && std::abs(next.range_m - hit.range_m) > 0.05F && rng.chance(0.5 * edge_chance);
      if (edge) range += share * (next.range_m - hit.range_m);
      if (hit && !lost) {
        result.points_m.emplace_back(static_cast<float>(range) * told.direction(u, v));
        result.intensities.push_back(brightness(material_of(world, hit)));
        result.persons.push_back(person_of(world, hit));
      } else if (params.organised) {
        result.points_m.emplace_back(Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
        result.intensities.push_back(0.0F);
        result.persons.push_back(0);
      }
    }
  }
  result.width = params.organised ? rays.width : static_cast<int>(result.points_m.size());
  result.height = params.organised ? rays.height : 1;
  return result;
}

}  // namespace limbcast::simulate
