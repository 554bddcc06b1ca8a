#pragma once

#include <Eigen/Geometry>
#include <array>

#include "modules/pose_fitter/refined/body_model.hpp"

namespace limbcast::pose_fitter::refined {

/// Stature for log_stature = 0 [m]; any number would do, this one keeps the unknown small.
inline constexpr Real kReferenceStatureM = 1.72;

using Step = Eigen::Matrix<Real, kUnknownCount, 1>;

/// A body in the range image's frame.
struct BodyState {
  std::array<Vec3, kPointCount> points;
  Real log_stature = 0.0;            ///< of stature / kReferenceStatureM
  Real log_girth = 0.0;              ///< of the radii against the mean body's
  Mat3 rotation = Mat3::Identity();  ///< columns: the trunk's left, up, front

  Real stature_m() const { return kReferenceStatureM * std::exp(log_stature); }
  Vec3 front() const { return rotation.col(2); }
};

bool operator==(const BodyState& a, const BodyState& b);

BodyState moved(const BodyState& body, const Step& step);

/// The neck's height over the shoulders of hanging arms, in statures.
inline constexpr Real kNeckOverShoulders = 0.0726;

enum class Legs { kStanding, kSitting };

/// Body with hanging arms, head at `head`, front turned by `yaw_rad` about `up` from looking at the
/// sensor.
BodyState rest_body(const Vec3& head, const Vec3& up, Real yaw_rad, Real log_stature, Legs legs);
/// Knees, ankles and toes as in rest_body, hanging on the hips as they are.
void set_legs(BodyState& body, Legs legs);
/// The point between a left one and its right one.
inline Vec3 middle(const BodyState& body, int left_point) {
  return 0.5 * (body.points[left_point] + body.points[left_point + 1]);
}
/// Toes as in rest_body, hanging on the ankles as they are.
void set_toes(BodyState& body);
/// The same silhouette seen from the other side: left and right swapped, the front reversed.
BodyState front_back_flipped(const BodyState& body);

/// A cone of a body in metres.
struct Cone {
  Vec3 from, axis;  ///< axis: to - from
  Real inverse_length2 = 0.0;
  Real radius_from = 0.0, radius_change = 0.0;
  Real radius(Real t) const { return radius_from + radius_change * t; }
  Vec3 point(Real t) const { return from + t * axis; }
  /// Place on the axis nearest to `p`, 0 to 1.
  Real nearest(const Vec3& p) const {
    return std::min(Real{1}, std::max(Real{0}, (p - from).dot(axis) * inverse_length2));
  }
};
using Cones = std::array<Cone, kConeCount>;
Cones make_cones_of(const BodyState& body);

}  // namespace limbcast::pose_fitter::refined
