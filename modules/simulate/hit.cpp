#include <cmath>

#include "modules/simulate/raycast.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Vector3f;

Vector3f solid_normal(const Solid& solid, const Vector3f& point) {
  const Vector3f p = solid.frame_from_solid.inverse() * point;
  Vector3f normal = Vector3f::Zero();
  if (solid.kind == Solid::Kind::kEllipsoid) {
    normal = p.cwiseQuotient(solid.half_m.cwiseProduct(solid.half_m)).normalized();
  } else if (solid.kind == Solid::Kind::kCylinder && std::abs(p.y()) < solid.half_m.y() * 0.9999F) {
    normal = Vector3f(p.x() / (solid.half_m.x() * solid.half_m.x()), 0.0F,
                      p.z() / (solid.half_m.z() * solid.half_m.z()))
                 .normalized();
  } else if (solid.kind == Solid::Kind::kCylinder) {
    normal.y() = p.y() > 0.0F ? 1.0F : -1.0F;
  } else {
    int axis = 0;
    (p.cwiseAbs() - solid.half_m).maxCoeff(&axis);
    normal[axis] = p[axis] > 0.0F ? 1.0F : -1.0F;
  }
  return solid.frame_from_solid.linear() * normal;
}

/// The part of `surface` that shapes it near `point`, which lies on it.
Surface nearby(const Surface& surface, const Vector3f& point, float reach_m) {
  Surface result;
  result.join_blend_m = surface.join_blend_m;
  for (const PrimitiveGroup& group : surface.groups) {
    PrimitiveGroup near{static_cast<int>(result.primitives.size()), 0, group.blend_m};
    for (int i = group.first; i < group.first + group.count; ++i) {
      const Primitive& primitive = surface.primitives[i];
      const float margin =
          group.blend_m + surface.join_blend_m + 2.0F * primitive.wrinkle_m + reach_m;
      if (primitive.distance_m(point) < margin) result.primitives.push_back(primitive);
    }
    near.count = static_cast<int>(result.primitives.size()) - near.first;
    if (near.count > 0) result.groups.push_back(near);
  }
  return result;
}

Vector3f surface_normal(const Surface& surface, const Vector3f& point) {
  constexpr float kStep = 0.001F;
  const Surface near = nearby(surface, point, 2.0F * kStep);
  Vector3f gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3f step = kStep * Vector3f::Unit(axis);
    gradient[axis] = near.distance_m(point + step) - near.distance_m(point - step);
  }
  return gradient.normalized();
}

}  // namespace

Vector3f normal_at(const World& world, const Hit& hit, const Vector3f& point) {
  return hit.solid >= 0 ? solid_normal(world.solids[hit.solid], point)
                        : surface_normal(world.surfaces[hit.surface], point);
}

const Material& material_of(const World& world, const Hit& hit) {
  if (hit.solid >= 0) return world.solids[hit.solid].material;
  const Surface& surface = world.surfaces[hit.surface];
  return surface.materials[surface.primitives[hit.primitive].material];
}

Vector3f texture_point(const World& world, const Hit& hit, const Vector3f& point) {
  if (hit.solid >= 0) return world.solids[hit.solid].frame_from_solid.inverse() * point;
  const Surface& surface = world.surfaces[hit.surface];
  const Primitive& primitive = surface.primitives[hit.primitive];
  if (surface.materials[primitive.material].pattern == Pattern::kFace)
    return surface.head_from_surface * point;
  return primitive.local * (point - primitive.origin);
}

int person_of(const World& world, const Hit& hit) {
  return hit.surface >= 0 ? world.surfaces[hit.surface].person : 0;
}

Part part_of(const World& world, const Hit& hit) {
  return hit.surface >= 0 ? world.surfaces[hit.surface].primitives[hit.primitive].part
                          : Part::kNone;
}

}  // namespace limbcast::simulate
