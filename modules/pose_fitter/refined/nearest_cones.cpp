#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core/hal/intrin.hpp>

#include "modules/pose_fitter/refined/cost.hpp"

namespace limbcast::pose_fitter::refined {

namespace {

using cv::v_float32x4;
using cv::v_int32x4;

constexpr std::size_t kLanes = 4;

/// Columns end in a whole vector; what is beyond the points is never read by anybody else.
std::size_t padded(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

void look_at_cone(const PointColumns& points, const Cone& cone, int index, NearestCones& nearest) {
  const auto all = [](Real value) { return cv::v_setall_f32(static_cast<float>(value)); };
  const v_float32x4 from_x = all(cone.from.x()), from_y = all(cone.from.y()),
                    from_z = all(cone.from.z()), axis_x = all(cone.axis.x()),
                    axis_y = all(cone.axis.y()), axis_z = all(cone.axis.z()),
                    inverse_length2 = all(cone.inverse_length2), radius = all(cone.radius_from),
                    change = all(cone.radius_change), zero = all(0.0), one = all(1.0);
  const v_int32x4 this_cone = cv::v_setall_s32(index);
  for (std::size_t i = 0; i < points.size(); i += kLanes) {
    const v_float32x4 x = cv::v_load(&points.x[i]) - from_x, y = cv::v_load(&points.y[i]) - from_y,
                      z = cv::v_load(&points.z[i]) - from_z;
    const v_float32x4 along = (x * axis_x + y * axis_y + z * axis_z) * inverse_length2;
    const v_float32x4 t = cv::v_min(cv::v_max(along, zero), one);
    const v_float32x4 ex = x - t * axis_x, ey = y - t * axis_y, ez = z - t * axis_z;
    const v_float32x4 d = cv::v_sqrt(ex * ex + ey * ey + ez * ez) - (radius + change * t);
    const v_float32x4 best = cv::v_load(&nearest.distance[i]);
    const v_float32x4 nearer = d < best;
    cv::v_store(&nearest.distance[i], cv::v_select(nearer, d, best));
    cv::v_store(&nearest.place[i], cv::v_select(nearer, t, cv::v_load(&nearest.place[i])));
    cv::v_store(&nearest.cone[i], cv::v_select(cv::v_reinterpret_as_s32(nearer), this_cone,
                                               cv::v_load(&nearest.cone[i])));
  }
}

}  // namespace

void nearest_cones(const PointColumns& points, const Cones& cones, unsigned parts,
                   const NearestCones* fixed, NearestCones& nearest) {
  const std::size_t count = padded(points.size());
  if (fixed != nullptr) {
    nearest = *fixed;
  } else {
    nearest.distance.assign(count, std::numeric_limits<float>::max());
    nearest.place.assign(count, 0.0F);
    nearest.cone.assign(count, 0);
  }
  for (int c = 0; c < kConeCount; ++c) {
    if ((bit(cone_specs()[c].part) & parts) != 0) look_at_cone(points, cones[c], c, nearest);
  }
}

}  // namespace limbcast::pose_fitter::refined
