#include "modules/simulate/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace limbcast::simulate {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

/// Folds of cloth, between -1 and 1, 10 to 20 cm from fold to fold; their slope stays below 80 per
/// metre.
float folds(const Vector3f& p) {
  return std::sin(36.0F * p.x() + 1.5F * std::sin(19.0F * p.y())) *
         std::sin(27.0F * p.y() + 1.5F * std::sin(22.0F * p.z() + 9.0F * p.x()));
}

}  // namespace

float Primitive::distance_m(const Vector3f& point) const {
  const Vector3f p = local * (point - origin);
  const float across = std::sqrt(p.x() * p.x() + p.z() * p.z());
  // Round cone: Quilez, Distance functions (iquilezles.org/articles/distfunctions).
  const float k = cosine * p.y() - slope * across;
  float distance = 0.0F;
  if (k < 0.0F) {
    distance = std::sqrt(across * across + p.y() * p.y()) - first_radius_m;
  } else if (k > cosine * length_m) {
    const float beyond = p.y() - length_m;
    distance = std::sqrt(across * across + beyond * beyond) - second_radius_m;
  } else {
    distance = cosine * across + slope * p.y() - first_radius_m;
  }
  if (wrinkle_m == 0.0F) return distance;
  if (distance > 4.0F * wrinkle_m) return distance - wrinkle_m;
  return distance - wrinkle_m * folds(p);
}

float Surface::distance_m(const Vector3f& point) const {
  float all = std::numeric_limits<float>::max();
  for (const PrimitiveGroup& group : groups) {
    float distance = std::numeric_limits<float>::max();
    for (int i = group.first; i < group.first + group.count; ++i) {
      distance = smooth_union(distance, primitives[i].distance_m(point), group.blend_m);
    }
    all = smooth_union(all, distance, join_blend_m);
  }
  return all;
}

int Surface::nearest_primitive(const Vector3f& point) const {
  int nearest = -1;
  float least = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const float distance = primitives[i].distance_m(point);
    if (distance < least) {
      least = distance;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

Surface Surface::transformed(const Eigen::Isometry3f& target_from_source) const {
  Surface result = *this;
  const Eigen::Matrix3f back = target_from_source.linear().transpose();
  for (Primitive& primitive : result.primitives) {
    primitive.local = primitive.local * back;
    primitive.origin = target_from_source * primitive.origin;
    primitive.center = target_from_source * primitive.center;
  }
  result.head_from_surface = head_from_surface * target_from_source.inverse();
  return result;
}

void SurfaceBuilder::begin_group(double blend_m) {
  PrimitiveGroup group;
  group.first = static_cast<int>(surface_.primitives.size());
  group.blend_m = static_cast<float>(blend_m);
  surface_.groups.push_back(group);
}

SurfaceBuilder& SurfaceBuilder::as(Part part, int material, double wrinkle_m) {
  part_ = part;
  material_ = material;
  wrinkle_m_ = wrinkle_m;
  return *this;
}

void SurfaceBuilder::cone(const Vector3d& from, const Vector3d& to, double from_radius_m,
                          double to_radius_m, const Vector3d& x_axis, double wide) {
  const Vector3d span = to - from;
  const double length = std::max(span.norm(), 1e-6);
  const Vector3d y = span / length;
  Vector3d x = x_axis - y * y.dot(x_axis);
  if (x.norm() < 1e-6) x = y.unitOrthogonal();
  x.normalize();
  Matrix3d rotation;
  rotation.row(0) = x / std::max(wide, 1.0);
  rotation.row(1) = y;
  rotation.row(2) = x.cross(y) * std::min(wide, 1.0);

  Primitive primitive;
  primitive.local = rotation.cast<float>();
  primitive.origin = from.cast<float>();
  primitive.center = (0.5 * (from + to)).cast<float>();
  primitive.length_m = static_cast<float>(length);
  primitive.first_radius_m = static_cast<float>(from_radius_m);
  primitive.second_radius_m = static_cast<float>(to_radius_m);
  // A ball that holds the other one has no flank.
  const double slope = std::clamp((to_radius_m - from_radius_m) / length, -0.99, 0.99);
  primitive.slope = static_cast<float>(-slope);
  primitive.cosine = static_cast<float>(std::sqrt(1.0 - slope * slope));
  const double stretch = std::max(std::max(wide, 1.0), 1.0 / std::min(wide, 1.0));
  primitive.bound_m = static_cast<float>(
      0.5 * length + std::max(from_radius_m, to_radius_m) * stretch + wrinkle_m_);
  add(primitive);
}

void SurfaceBuilder::ellipsoid(const Vector3d& center, const Matrix3d& axes,
                               const Vector3d& half_axes_m) {
  const double least = half_axes_m.minCoeff();
  Primitive primitive;
  primitive.local =
      ((least * half_axes_m.cwiseInverse()).asDiagonal() * axes.transpose()).cast<float>();
  primitive.origin = center.cast<float>();
  primitive.center = primitive.origin;
  primitive.length_m = 0.0F;
  primitive.first_radius_m = primitive.second_radius_m = static_cast<float>(least);
  primitive.bound_m = static_cast<float>(half_axes_m.maxCoeff() + wrinkle_m_);
  add(primitive);
}

void SurfaceBuilder::ball(const Vector3d& center, double radius_m) {
  ellipsoid(center, Matrix3d::Identity(), Vector3d::Constant(radius_m));
}

void SurfaceBuilder::add(Primitive primitive) {
  primitive.part = part_;
  primitive.material = static_cast<std::uint8_t>(material_);
  primitive.wrinkle_m = static_cast<float>(wrinkle_m_);
  surface_.primitives.push_back(primitive);
  ++surface_.groups.back().count;
}

void SurfaceBuilder::head(const Vector3d& center, const Matrix3d& axes) {
  Eigen::Isometry3d surface_from_head = Eigen::Isometry3d::Identity();
  surface_from_head.linear() = axes;
  surface_from_head.translation() = center;
  surface_.head_from_surface = surface_from_head.inverse().cast<float>();
}

Surface SurfaceBuilder::build(int person) && {
  surface_.person = person;
  return std::move(surface_);
}

}  // namespace limbcast::simulate
