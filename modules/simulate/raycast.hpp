#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

#include "modules/simulate/surface.hpp"

namespace limbcast::simulate {

/// A solid of furniture and rooms, hit exactly.
struct Solid {
  enum class Kind : std::uint8_t {
    kBox,
    kEllipsoid,
    kCylinder
  };  ///< a cylinder stands along its y axis
  Kind kind = Kind::kBox;
  Eigen::Isometry3f frame_from_solid = Eigen::Isometry3f::Identity();
  Eigen::Vector3f half_m = Eigen::Vector3f::Ones();  ///< half the extents along the solid's axes
  Material material;
};

/// All that a sensor can see, in the frame of the sensor.
struct World {
  std::vector<Solid> solids;
  std::vector<Surface> surfaces;
};

/// What one ray met.
struct Hit {
  float range_m = 0.0F;  ///< along the ray, 0 = nothing
  std::int16_t solid = -1, surface = -1, primitive = -1;
  explicit operator bool() const { return range_m > 0.0F; }
};

/// Rays from one point in rows and columns; neighbours in the grid are neighbours in direction.
struct RayGrid {
  int width = 0, height = 0;
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  std::function<Eigen::Vector3f(int u, int v)> direction;  ///< unit vectors
};

struct HitImage {
  int width = 0, height = 0;
  std::vector<Hit> hits;
  const Hit& at(int u, int v) const { return hits[static_cast<std::size_t>(v) * width + u]; }
};

struct RaycastParams {
  float max_range_m = 30.0F;
  float precision_m = 0.0003F;  ///< a surface counts as met from here on; a third of a millimetre
  /// Share of the distance that a step goes: folds of cloth are up to 6 mm high and 80 / m steep,
  /// so that distances may be told too long by up to 1 + 0.48.
  float step_share = 0.7F;
  int max_steps =
      256;  ///< flat things (a hat's brim) need many: their distances are told far too short
};

/// Follows every ray to the first thing it meets. The result does not depend on the number of
/// threads.
HitImage raycast(const World& world, const RayGrid& rays, const RaycastParams& params = {});

/// Outward normal at a point that a ray met.
Eigen::Vector3f normal_at(const World& world, const Hit& hit, const Eigen::Vector3f& point);
const Material& material_of(const World& world, const Hit& hit);
/// The point in the coordinates of the solid or primitive that was met, where its texture lives
/// [m].
Eigen::Vector3f texture_point(const World& world, const Hit& hit, const Eigen::Vector3f& point);
/// Person at this pixel, 0 = none.
int person_of(const World& world, const Hit& hit);
Part part_of(const World& world, const Hit& hit);

}  // namespace limbcast::simulate
