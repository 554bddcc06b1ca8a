#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "common/cloud/cloud.hpp"

namespace limbcast::simulate {

/// What a point of a surface belongs to; the values of NAME_labels.png.
enum class Part : std::uint8_t {
  kNone = 0,
  kFace = 1,
  kHair = 2,
  kNeck = 3,
  kTrunk = 4,
  kUpperArmLeft = 5,
  kUpperArmRight = 6,
  kForearmLeft = 7,
  kForearmRight = 8,
  kHandLeft = 9,
  kHandRight = 10,
  kThighLeft = 11,
  kThighRight = 12,
  kShankLeft = 13,
  kShankRight = 14,
  kFootLeft = 15,
  kFootRight = 16,
  kSkirt = 17,
  kBag = 18,
};
/// The part of that side where `left` is the one of the left side.
constexpr Part on_side(Part left, int side) {
  return static_cast<Part>(static_cast<int>(left) + side);
}

enum class Pattern : std::uint8_t { kPlain, kStripes, kChecks, kBlotches, kWood, kPicture, kFace };

/// How a surface looks; patterns are solid textures in the object's own coordinates, a face in
/// those of the head.
struct Material {
  Bgr color, second;
  Pattern pattern = Pattern::kPlain;
  float scale_m = 0.05F;  ///< period of the pattern; of a face: a mean adult's stature [m]
  float grain = 0.06F;    ///< relative amplitude of the fine texture, 0 = perfectly even
};

/// A cone with round ends between two balls, in coordinates that may be squeezed: local = squeeze *
/// rotation * (p - origin), the cone's axis from (0, 0, 0) to (0, length, 0).
///
/// The squeeze never exceeds 1, so that distances in local coordinates never exceed the true ones
/// and tracing along a ray with them cannot jump through the surface.
struct Primitive {
  Eigen::Matrix3f local;
  Eigen::Vector3f origin, center;
  float bound_m = 0.0F;  ///< radius about `center` that holds the primitive
  float length_m = 0.0F, first_radius_m = 0.0F, second_radius_m = 0.0F;
  float slope = 0.0F, cosine = 1.0F;  ///< of the cone's flank, from length and radii
  float wrinkle_m = 0.0F;
  Part part = Part::kNone;
  std::uint8_t material = 0;

  /// Distance from `point` to the surface, never more than the true one where there are no
  /// wrinkles.
  float distance_m(const Eigen::Vector3f& point) const;
};

/// Primitives that flow into one another.
struct PrimitiveGroup {
  int first = 0, count = 0;
  float blend_m = 0.0F;  ///< width of the zone where two of them merge
};

/// A smooth closed surface made of primitives.
struct Surface {
  std::vector<Primitive> primitives;
  std::vector<PrimitiveGroup> groups;
  std::vector<Material> materials;
  float join_blend_m = 0.006F;  ///< between groups
  int person = 0;               ///< index in the mask, 0 = no person
  /// Where the face is painted: x own left, y up, z forward, from the head's centre.
  Eigen::Isometry3f head_from_surface = Eigen::Isometry3f::Identity();

  float distance_m(const Eigen::Vector3f& point) const;
  /// The primitive that is nearest to `point`.
  int nearest_primitive(const Eigen::Vector3f& point) const;
  Surface transformed(const Eigen::Isometry3f& target_from_source) const;
};

/// Union of two distances that rounds the edge between them over `blend_m` (polynomial, by Quilez).
inline float smooth_union(float a, float b, float blend_m) {
  const float gap = blend_m - std::abs(a - b);
  const float least = a < b ? a : b;
  return gap > 0.0F ? least - gap * gap / (4.0F * blend_m) : least;
}

/// Puts a surface together.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(std::vector<Material> materials) {
    surface_.materials = std::move(materials);
  }

  /// Primitives added from here on flow into one another over `blend_m`.
  void begin_group(double blend_m);
  /// What the next primitives are.
  SurfaceBuilder& as(Part part, int material, double wrinkle_m = 0.0);
  /// A round cone; its cross section is `wide` times as wide along `x_axis` as across it.
  void cone(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double from_radius_m,
            double to_radius_m, const Eigen::Vector3d& x_axis = Eigen::Vector3d::UnitX(),
            double wide = 1.0);
  /// An ellipsoid with half axes along the columns of `axes`.
  void ellipsoid(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes,
                 const Eigen::Vector3d& half_axes_m);
  void ball(const Eigen::Vector3d& center, double radius_m);
  /// The head's place in the surface, for materials with a face.
  void head(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes);
  Surface build(int person) &&;

 private:
  void add(Primitive primitive);

  Surface surface_;
  Part part_ = Part::kNone;
  int material_ = 0;
  double wrinkle_m_ = 0.0;
};

}  // namespace limbcast::simulate
