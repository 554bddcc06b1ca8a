#include "modules/pose_fitter/refined/body_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limbcast::pose_fitter::refined {
namespace {

Vec3 sum(const Anchor& anchor, const std::array<Vec3, kPointCount>& points) {
  Vec3 result = Vec3::Zero();
  for (const Weight& weight : anchor) {
    if (weight.weight != 0.0) result += weight.weight * points[weight.point];
  }
  return result;
}

/// Offset of the left side seen from `side`.
Vec3 to_side(const Vec3& left, int side) {
  return {side_sign(side) * left.x(), left.y(), left.z()};
}

/// Puts a point of both sides at an offset from another one, in statures in the body's frame, for
/// the left side.
void hang_pair(BodyState& body, int point, int from, const Vec3& left) {
  for (int side = 0; side < 2; ++side) {
    body.points[on_side(point, side)] =
        body.points[on_side(from, side)] + body.rotation * (body.stature_m() * to_side(left, side));
  }
}

}  // namespace

bool operator==(const BodyState& a, const BodyState& b) {
  return a.points == b.points && a.log_stature == b.log_stature && a.log_girth == b.log_girth &&
         a.rotation == b.rotation;
}

BodyState moved(const BodyState& body, const Step& step) {
  BodyState result = body;
  for (int i = 0; i < kPointCount; ++i) result.points[i] += step.segment<3>(3 * i);
  result.log_stature += step[kLogStature];
  result.log_girth += step[kLogGirth];
  const Vec3 turn = step.segment<3>(kRotation);
  const Real angle = turn.norm();
  if (angle > 1e-12) {
    result.rotation =
        body.rotation * Eigen::AngleAxis<Real>(angle, turn / angle).toRotationMatrix();
  }
  return result;
}

BodyState rest_body(const Vec3& head, const Vec3& up, Real yaw_rad, Real log_stature, Legs legs) {
  BodyState body;
  Vec3 to_sensor = -head;
  to_sensor -= up * to_sensor.dot(up);
  if (to_sensor.norm() < 1e-6) to_sensor = up.unitOrthogonal();
  const Vec3 front = Eigen::AngleAxis<Real>(yaw_rad, up) * to_sensor.normalized();
  body.rotation << up.cross(front), up, front;
  body.log_stature = log_stature;
  const auto offset = [&](const Vec3& in_statures) {
    return Vec3(body.rotation * (body.stature_m() * in_statures));
  };
  body.points[kHead] = head;
  body.points[kNeck] = head - offset(body_offsets()[0].mean);
  body.points[kChest] = body.points[kNeck] + offset(body_offsets()[1].mean);
  body.points[kPelvis] = body.points[kNeck] + offset(body_offsets()[2].mean);
  for (int side = 0; side < 2; ++side) {
    const auto hang = [&](int point, int from, const Vec3& left) {
      body.points[on_side(point, side)] = body.points[from] + offset(to_side(left, side));
    };
    hang(kShoulder, kNeck, {0.102, -kNeckOverShoulders, 0.0067});
    hang(kElbow, on_side(kShoulder, side), {0.02, -0.146, -0.005});
    hang(kWrist, on_side(kElbow, side), {0.0, -0.146, 0.02});
    hang(kHand, on_side(kWrist, side), {0.0, -0.043, 0.005});
    hang(kHip, kPelvis, {0.061, 0.0, 0.0});
  }
  set_legs(body, legs);
  return body;
}

void set_legs(BodyState& body, Legs legs) {
  const bool standing = legs == Legs::kStanding;
  hang_pair(body, kKnee, kHip, standing ? Vec3(0.01, -0.237, 0.01) : Vec3(0.03, -0.03, 0.235));
  hang_pair(body, kAnkle, kKnee, standing ? Vec3(0.005, -0.25, -0.01) : Vec3(0.005, -0.248, 0.02));
  set_toes(body);
}

void set_toes(BodyState& body) { hang_pair(body, kToe, kAnkle, {0.02, -0.03, 0.09}); }

BodyState front_back_flipped(const BodyState& body) {
  BodyState flipped = body;
  for (int left = kShoulder; left < kPointCount; left += 2) {
    std::swap(flipped.points[left], flipped.points[left + 1]);
  }
  flipped.rotation.col(0) = -body.rotation.col(0);
  flipped.rotation.col(2) = -body.rotation.col(2);
  const Vec3 front = flipped.front();
  const Real stature = body.stature_m();
  // The chest stands before the line neck-pelvis, the knee before the line hip-ankle, the toe
  // before the ankle: put them on the new front.
  flipped.points[kChest] += front * (0.034 * stature);
  for (int side = 0; side < 2; ++side) {
    Vec3& knee = flipped.points[on_side(kKnee, side)];
    const Vec3& ankle = flipped.points[on_side(kAnkle, side)];
    const Real ahead = front.dot(knee - 0.5 * (flipped.points[on_side(kHip, side)] + ankle));
    if (ahead < 0.01 * stature) knee += front * (0.02 * stature - ahead);
    Vec3& toe = flipped.points[on_side(kToe, side)];
    const Real toe_ahead = (toe - ankle).dot(front);
    if (toe_ahead < 0.0) toe -= 2.0 * toe_ahead * front;
  }
  return flipped;
}

Cones make_cones_of(const BodyState& body) {
  Cones cones;
  const Real stature = body.stature_m(), with_girth = stature * std::exp(body.log_girth);
  for (int i = 0; i < kConeCount; ++i) {
    const ConeSpec& spec = cone_specs()[i];
    const Vec3 offset = spec.forward_offset * stature * body.front();
    const Real scale = spec.grows_with_girth ? with_girth : stature;
    Cone& cone = cones[i];
    cone.from = sum(spec.from, body.points) + offset;
    cone.axis = sum(spec.to, body.points) + offset - cone.from;
    cone.inverse_length2 = 1.0 / (cone.axis.squaredNorm() + 1e-9);
    cone.radius_from = scale * spec.radius_from;
    cone.radius_change = scale * (spec.radius_to - spec.radius_from);
  }
  return cones;
}

}  // namespace limbcast::pose_fitter::refined
