#include <array>
#include <cmath>
#include <limits>

#include "common/simd.hpp"
#include "modules/pose_fitter/refined/cost/cost.hpp"

namespace limbcast::pose_fitter::refined {

namespace {

/// A cone in the points' precision.
struct FloatCone {
  int index;
  float from_x, from_y, from_z, axis_x, axis_y, axis_z, inverse_length2, radius, radius_change;
};

FloatCone to_float(int index, const Cone& cone) {
  const Eigen::Vector3f from = cone.from.cast<float>(), axis = cone.axis.cast<float>();
  return {index,
          from.x(),
          from.y(),
          from.z(),
          axis.x(),
          axis.y(),
          axis.z(),
          static_cast<float>(cone.inverse_length2),
          static_cast<float>(cone.radius_from),
          static_cast<float>(cone.radius_change)};
}

LIMBCAST_SIMD void look_at_cones(const PointColumns& points, const FloatCone* begin,
                                 const FloatCone* end, NearestCones& nearest) {
  constexpr std::size_t kLanes = 8;
  const Float8 zero = {}, one = zero + 1.0F;
  for (std::size_t i = 0; i < points.x.size(); i += kLanes) {
    Float8 px, py, pz, distance, place;
    Int8 nearest_cone;
    load(&points.x[i], px);
    load(&points.y[i], py);
    load(&points.z[i], pz);
    load(&nearest.distance[i], distance);
    load(&nearest.place[i], place);
    load(&nearest.cone[i], nearest_cone);
    for (const FloatCone* cone = begin; cone != end; ++cone) {
      const Float8 x = px - cone->from_x, y = py - cone->from_y, z = pz - cone->from_z;
      const Float8 along =
          (x * cone->axis_x + y * cone->axis_y + z * cone->axis_z) * cone->inverse_length2;
      const Float8 from_start = along > zero ? along : zero;
      const Float8 t = from_start < one ? from_start : one;
      const Float8 ex = x - t * cone->axis_x, ey = y - t * cone->axis_y, ez = z - t * cone->axis_z;
      Float8 root = ex * ex + ey * ey + ez * ez;
      for (std::size_t lane = 0; lane < kLanes; ++lane) root[lane] = std::sqrt(root[lane]);
      const Float8 d = root - (cone->radius + cone->radius_change * t);
      const Int8 nearer = d < distance;
      distance = nearer ? d : distance;
      place = nearer ? t : place;
      nearest_cone = nearer ? Int8{} + cone->index : nearest_cone;
    }
    store(distance, &nearest.distance[i]);
    store(place, &nearest.place[i]);
    store(nearest_cone, &nearest.cone[i]);
  }
}

}  // namespace

void nearest_cones(const PointColumns& points, const Cones& cones, unsigned parts,
                   const NearestCones* fixed, NearestCones& nearest) {
  const std::size_t count = points.x.size();
  if (fixed != nullptr) {
    nearest = *fixed;
  } else {
    nearest.distance.assign(count, std::numeric_limits<float>::max());
    nearest.place.assign(count, 0.0F);
    nearest.cone.assign(count, 0);
  }
  std::array<FloatCone, kConeCount> looked_at;
  int used = 0;
  for (int c = 0; c < kConeCount; ++c) {
    if ((bit(cone_specs()[c].part) & parts) != 0) looked_at[used++] = to_float(c, cones[c]);
  }
  look_at_cones(points, looked_at.data(), looked_at.data() + used, nearest);
}

}  // namespace limbcast::pose_fitter::refined
