#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/pose_fitter/refined/cost.hpp"

namespace limbcast::pose_fitter::refined {

// The inner loop has no branches and no calls, so that the compiler turns it into vector
// instructions (CMakeLists.txt allows it to ignore errno and traps of the square root).
void nearest_cones(const PointColumns& points, const Cones& cones, unsigned parts,
                   const NearestCones* fixed, NearestCones& nearest) {
  const std::size_t count = points.size();
  if (fixed != nullptr) {
    nearest = *fixed;
  } else {
    nearest.distance.assign(count, std::numeric_limits<float>::max());
    nearest.place.assign(count, 0.0F);
    nearest.cone.assign(count, 0);
  }
  const float* __restrict px = points.x.data();
  const float* __restrict py = points.y.data();
  const float* __restrict pz = points.z.data();
  float* __restrict distance = nearest.distance.data();
  float* __restrict place = nearest.place.data();
  std::int32_t* __restrict index = nearest.cone.data();
  for (std::int32_t c = 0; c < kConeCount; ++c) {
    if ((bit(cone_specs()[c].part) & parts) == 0) continue;
    const Eigen::Vector3f from = cones[c].from.cast<float>(), axis = cones[c].axis.cast<float>();
    const float fx = from.x(), fy = from.y(), fz = from.z(), ax = axis.x(), ay = axis.y(),
                az = axis.z();
    const float inverse_length2 = static_cast<float>(cones[c].inverse_length2);
    const float radius = static_cast<float>(cones[c].radius_from);
    const float change = static_cast<float>(cones[c].radius_change);
    for (std::size_t i = 0; i < count; ++i) {
      const float dx = px[i] - fx, dy = py[i] - fy, dz = pz[i] - fz;
      float t = (dx * ax + dy * ay + dz * az) * inverse_length2;
      t = t < 0.0F ? 0.0F : t;
      t = t > 1.0F ? 1.0F : t;
      const float ex = dx - t * ax, ey = dy - t * ay, ez = dz - t * az;
      const float d = std::sqrt(ex * ex + ey * ey + ez * ez) - (radius + change * t);
      const bool nearer = d < distance[i];
      distance[i] = nearer ? d : distance[i];
      place[i] = nearer ? t : place[i];
      index[i] = nearer ? c : index[i];
    }
  }
}

}  // namespace limbcast::pose_fitter::refined
