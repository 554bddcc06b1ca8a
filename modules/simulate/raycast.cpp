#include "modules/simulate/raycast.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limbcast::simulate {
namespace {

using Eigen::Vector3f;

constexpr int kTile = 8;  // rays in a tile's row and column: small enough to drop most primitives

/// A tile's rays lie in this cone.
struct RayCone {
  Vector3f origin, axis;
  float cosine = 1.0F, sine = 0.0F;

  /// Whether a ball may be met, and then between which ranges.
  bool meets(const Vector3f& center, float radius_m, float& first, float& last) const {
    const Vector3f to = center - origin;
    const float along = to.dot(axis);
    const float across = std::sqrt(std::max(0.0F, to.squaredNorm() - along * along));
    if (across * cosine - along * sine > radius_m || along < -radius_m) return false;
    const float distance = to.norm();
    first = std::max(0.0F, distance - radius_m);
    last = distance + radius_m;
    return true;
  }
};

/// The primitives of a surface that a tile's rays may meet.
struct Candidates {
  const Surface* surface = nullptr;
  int surface_index = 0;
  float first_m = 0.0F, last_m = 0.0F;
  std::vector<int> primitives;  ///< in the surface's order
  std::vector<int> group_ends;  ///< into `primitives`, one a group that has any
  std::vector<float> blends_m;

  float distance_m(const Vector3f& point) const {
    float all = std::numeric_limits<float>::max();
    std::size_t i = 0;
    for (std::size_t group = 0; group < group_ends.size(); ++group) {
      float distance = std::numeric_limits<float>::max();
      for (; i < static_cast<std::size_t>(group_ends[group]); ++i) {
        distance = smooth_union(distance, surface->primitives[primitives[i]].distance_m(point),
                                blends_m[group]);
      }
      all = smooth_union(all, distance, surface->join_blend_m);
    }
    return all;
  }
};

/// Smooth unions swell the surface by at most a quarter of the blend for each merged primitive, and
/// a primitive acts on the surface from at most one blend away.
Candidates candidates_of(const Surface& surface, int surface_index, const RayCone& cone) {
  Candidates result;
  result.surface = &surface;
  result.surface_index = surface_index;
  result.first_m = std::numeric_limits<float>::max();
  for (const PrimitiveGroup& group : surface.groups) {
    const std::size_t before = result.primitives.size();
    for (int i = group.first; i < group.first + group.count; ++i) {
      const Primitive& primitive = surface.primitives[i];
      const float margin = group.blend_m + surface.join_blend_m;
      float first = 0.0F;
      float last = 0.0F;
      if (!cone.meets(primitive.center, primitive.bound_m + margin, first, last)) continue;
      result.primitives.push_back(i);
      result.first_m = std::min(result.first_m, first);
      result.last_m = std::max(result.last_m, last);
    }
    if (result.primitives.size() == before) continue;
    result.group_ends.push_back(static_cast<int>(result.primitives.size()));
    result.blends_m.push_back(group.blend_m);
  }
  return result;
}

/// Sphere tracing: Hart, The Visual Computer 12 (1996).
float trace(const Candidates& candidates, const Vector3f& origin, const Vector3f& direction,
            float limit_m, const RaycastParams& params) {
  float range = candidates.first_m;
  const float end = std::min(candidates.last_m, limit_m);
  for (int step = 0; step < params.max_steps && range < end; ++step) {
    const float distance = candidates.distance_m(origin + range * direction);
    if (distance < params.precision_m) return range;
    range += std::max(params.step_share * distance, params.precision_m);
  }
  return 0.0F;
}

float hit_box(const Vector3f& origin, const Vector3f& direction, const Vector3f& half) {
  float enter = 0.0F;
  float leave = std::numeric_limits<float>::max();
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse =
        1.0F / direction[axis];  // infinite for a parallel ray: the comparisons still hold
    const float a = (-half[axis] - origin[axis]) * inverse;
    const float b = (half[axis] - origin[axis]) * inverse;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : 0.0F;
}

float hit_ellipsoid(const Vector3f& origin, const Vector3f& direction, const Vector3f& half) {
  const Vector3f o = origin.cwiseQuotient(half);
  const Vector3f d = direction.cwiseQuotient(half);
  const float a = d.squaredNorm();
  const float b = o.dot(d);
  const float c = o.squaredNorm() - 1.0F;
  const float root = b * b - a * c;
  return root > 0.0F && c > 0.0F ? std::max(0.0F, (-b - std::sqrt(root)) / a) : 0.0F;
}

float hit_cylinder(const Vector3f& origin, const Vector3f& direction, const Vector3f& half) {
  const Vector3f o(origin.x() / half.x(), 0.0F, origin.z() / half.z());
  const Vector3f d(direction.x() / half.x(), 0.0F, direction.z() / half.z());
  const float a = std::max(d.squaredNorm(), 1e-12F);
  const float b = o.dot(d);
  const float root = b * b - a * (o.squaredNorm() - 1.0F);
  if (root <= 0.0F) return 0.0F;
  const float inverse = 1.0F / direction.y();
  const float cap_a = (-half.y() - origin.y()) * inverse;
  const float cap_b = (half.y() - origin.y()) * inverse;
  const float enter = std::max((-b - std::sqrt(root)) / a, std::min(cap_a, cap_b));
  const float leave = std::min((-b + std::sqrt(root)) / a, std::max(cap_a, cap_b));
  return enter < leave && enter > 0.0F ? enter : 0.0F;
}

float hit_solid(const Solid& solid, const Vector3f& origin, const Vector3f& direction) {
  const Eigen::Matrix3f back = solid.frame_from_solid.linear().transpose();
  const Vector3f o = back * (origin - solid.frame_from_solid.translation());
  const Vector3f d = back * direction;
  switch (solid.kind) {
    case Solid::Kind::kBox:
      return hit_box(o, d, solid.half_m);
    case Solid::Kind::kEllipsoid:
      return hit_ellipsoid(o, d, solid.half_m);
    case Solid::Kind::kCylinder:
      return hit_cylinder(o, d, solid.half_m);
  }
  return 0.0F;
}

RayCone cone_of(const RayGrid& rays, int u0, int v0, int u1, int v1) {
  RayCone cone;
  cone.origin = rays.origin;
  Vector3f sum = Vector3f::Zero();
  for (int v = v0; v < v1; ++v) {
    for (int u = u0; u < u1; ++u) sum += rays.direction(u, v);
  }
  cone.axis = sum.normalized();
  for (int v = v0; v < v1; ++v) {
    for (int u = u0; u < u1; ++u)
      cone.cosine = std::min(cone.cosine, rays.direction(u, v).dot(cone.axis));
  }
  cone.cosine = std::max(0.0F, cone.cosine - 1e-5F);
  cone.sine = std::sqrt(1.0F - cone.cosine * cone.cosine);
  return cone;
}

void raycast_tile(const World& world, const RayGrid& rays, const RaycastParams& params, int u0,
                  int v0, HitImage& image) {
  const int u1 = std::min(u0 + kTile, rays.width);
  const int v1 = std::min(v0 + kTile, rays.height);
  const RayCone cone = cone_of(rays, u0, v0, u1, v1);
  std::vector<int> solids;
  for (std::size_t i = 0; i < world.solids.size(); ++i) {
    const Solid& solid = world.solids[i];
    float first = 0.0F;
    float last = 0.0F;
    if (cone.meets(solid.frame_from_solid.translation(), solid.half_m.norm(), first, last)) {
      solids.push_back(static_cast<int>(i));
    }
  }
  std::vector<Candidates> surfaces;
  for (std::size_t i = 0; i < world.surfaces.size(); ++i) {
    surfaces.push_back(candidates_of(world.surfaces[i], static_cast<int>(i), cone));
    if (surfaces.back().primitives.empty()) surfaces.pop_back();
  }
  for (int v = v0; v < v1; ++v) {
    for (int u = u0; u < u1; ++u) {
      const Vector3f direction = rays.direction(u, v);
      Hit hit;
      float nearest = params.max_range_m;
      for (const int i : solids) {
        const float range = hit_solid(world.solids[i], rays.origin, direction);
        if (range <= 0.0F || range >= nearest) continue;
        nearest = hit.range_m = range;
        hit.solid = static_cast<std::int16_t>(i);
      }
      for (const Candidates& candidates : surfaces) {
        const float range = trace(candidates, rays.origin, direction, nearest, params);
        if (range <= 0.0F) continue;
        nearest = hit.range_m = range;
        hit.solid = -1;
        hit.surface = static_cast<std::int16_t>(candidates.surface_index);
      }
      if (hit.surface >= 0) {
        hit.primitive = static_cast<std::int16_t>(
            world.surfaces[hit.surface].nearest_primitive(rays.origin + hit.range_m * direction));
      }
      image.hits[static_cast<std::size_t>(v) * image.width + u] = hit;
    }
  }
}

}  // namespace

HitImage raycast(const World& world, const RayGrid& rays, const RaycastParams& params) {
  HitImage image;
  image.width = rays.width;
  image.height = rays.height;
  image.hits.resize(static_cast<std::size_t>(rays.width) * rays.height);
  const int tile_rows = (rays.height + kTile - 1) / kTile;
  tbb::parallel_for(tbb::blocked_range<int>(0, tile_rows),
                    [&](const tbb::blocked_range<int>& rows) {
                      for (int row = rows.begin(); row != rows.end(); ++row) {
                        for (int u = 0; u < rays.width; u += kTile)
                          raycast_tile(world, rays, params, u, row * kTile, image);
                      }
                    });
  return image;
}

}  // namespace limbcast::simulate
