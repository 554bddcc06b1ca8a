#include "modules/simulate/skeleton.hpp"

#include <algorithm>
#include <cmath>

namespace limbcast::simulate {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d about_x(double angle) { return AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix(); }
Matrix3d about_y(double angle) { return AngleAxisd(angle, Vector3d::UnitY()).toRotationMatrix(); }
Matrix3d about_z(double angle) { return AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix(); }

/// From the frame of a side (x outward) to that of the body (x to the own left).
Vector3d to_body(const Vector3d& v, int side) { return {side == 0 ? v.x() : -v.x(), v.y(), v.z()}; }

Matrix3d frame_along(const Vector3d& y_axis, const Vector3d& x_hint) {
  const Vector3d y = y_axis.normalized();
  Vector3d x = x_hint - y * y.dot(x_hint);
  if (x.norm() < 1e-6) x = y.unitOrthogonal();
  x.normalize();
  Matrix3d frame;
  frame << x, y, x.cross(y);
  return frame;
}

void place_trunk(const BodyShape& body, const Posture& posture, Skeleton& skeleton) {
  const double height = body.stature_m;
  const Matrix3d& pelvis = skeleton.pelvis_R;
  const auto spine = [&](double share) {
    return Matrix3d(about_x(posture.lean_rad * share) * about_z(-posture.side_lean_rad * share) *
                    about_y(posture.twist_rad * share));
  };
  skeleton.chest_R = pelvis * spine(1.0);
  skeleton.head_R = skeleton.chest_R * about_y(posture.head_yaw_rad) *
                    about_x(posture.head_pitch_rad) * about_z(-posture.head_roll_rad);
  // The spine's curve in the side view, from the profiles of bodies D1-D3.
  skeleton[Joint::kChest] = skeleton[Joint::kPelvis] +
                            pelvis * spine(0.5) * Vector3d(0, body.pelvis_chest_m, 0.020 * height);
  skeleton[Joint::kNeck] =
      skeleton[Joint::kChest] + skeleton.chest_R * Vector3d(0, body.chest_neck_m, -0.012 * height);
  const Matrix3d neck = skeleton.chest_R * about_y(0.5 * posture.head_yaw_rad) *
                        about_x(0.6 * posture.head_pitch_rad) *
                        about_z(-0.6 * posture.head_roll_rad);
  skeleton[Joint::kHead] =
      skeleton[Joint::kNeck] + neck * Vector3d(0, 0.96 * body.neck_head_m, 0.28 * body.neck_head_m);
  const double head = body.head_scale * height;
  skeleton.head_top = skeleton[Joint::kHead] + skeleton.head_R * Vector3d(0, 0.050 * head, 0);
  skeleton.eye = skeleton[Joint::kHead] + skeleton.head_R * Vector3d(0, 0.000, 0.048 * head);
}

void place_arm(const BodyShape& body, const ArmPose& pose, int side, Skeleton& skeleton) {
  const Matrix3d& chest = skeleton.chest_R;
  const auto joint = [&](Joint left) -> Vector3d& { return skeleton[on_side(left, Side(side))]; };
  const Vector3d upper = chest * to_body(pose.upper.normalized(), side);
  const Vector3d fore = chest * to_body(pose.fore.normalized(), side);
  joint(Joint::kShoulderLeft) =
      skeleton[Joint::kNeck] +
      chest * to_body(shoulder_offset_m(body, pose.upper.normalized()), side);
  joint(Joint::kElbowLeft) = joint(Joint::kShoulderLeft) + body.upper_arm_m * upper;
  joint(Joint::kWristLeft) = joint(Joint::kElbowLeft) + body.forearm_m * fore;

  // The thumb of a hanging arm points forward, of a raised one up.
  const Vector3d thumb_hint = chest * to_body({0.0, 0.6, 0.8}, side);
  Matrix3d hand = frame_along(fore, thumb_hint);
  if (side == 1) hand.col(2) = -hand.col(2);  // out of the back of the hand on either side
  hand = AngleAxisd(side == 0 ? pose.hand_roll_rad : -pose.hand_roll_rad, fore) * hand;
  hand = AngleAxisd(side == 0 ? -pose.hand_bend_rad : pose.hand_bend_rad, hand.col(0)) * hand;
  skeleton.hand_R[side] = hand;
  skeleton.hand[side] = joint(Joint::kWristLeft) + 0.42 * body.hand_m * hand.col(1);
  const double tip = pose.hand == HandShape::kFist ? 0.55 : 1.0;
  skeleton.fingertip[side] = joint(Joint::kWristLeft) + tip * body.hand_m * hand.col(1);
}

void place_leg(const BodyShape& body, const LegPose& pose, int side, const Matrix3d& level,
               Skeleton& skeleton) {
  const auto joint = [&](Joint left) -> Vector3d& { return skeleton[on_side(left, Side(side))]; };
  joint(Joint::kHipLeft) =
      skeleton[Joint::kPelvis] + level * to_body({body.hip_half_m, 0, 0}, side);
  joint(Joint::kKneeLeft) =
      joint(Joint::kHipLeft) + body.thigh_m * (level * to_body(pose.thigh.normalized(), side));
  const Vector3d shank = level * to_body(pose.shank.normalized(), side);
  joint(Joint::kAnkleLeft) = joint(Joint::kKneeLeft) + body.shank_m * shank;

  const double outward = side == 0 ? pose.foot_yaw_rad : -pose.foot_yaw_rad;
  skeleton.foot_R[side] = level * about_y(outward) * about_x(pose.foot_pitch_rad);
  skeleton.toe[side] =
      joint(Joint::kAnkleLeft) +
      skeleton.foot_R[side] * Vector3d(0, -0.6 * body.ankle_height_m, 0.72 * body.foot_m);
}

/// Height of the lowest part of a foot's sole.
double sole_height(const BodyShape& body, const Skeleton& skeleton, int side) {
  const Vector3d& ankle = skeleton[on_side(Joint::kAnkleLeft, Side(side))];
  const Matrix3d& foot = skeleton.foot_R[side];
  const double heel = (ankle + foot * Vector3d(0, -body.ankle_height_m, -0.2 * body.foot_m)).y();
  const double ball = (ankle + foot * Vector3d(0, -body.ankle_height_m, 0.6 * body.foot_m)).y();
  return std::min(heel, ball);
}

/// Height of the lowest part of the body: a sole, a knee, the seat.
double lowest_height(const BodyShape& body, const Skeleton& skeleton) {
  const double knee_m = 0.035 * body.stature_m;
  double lowest = seat_height_m(body, skeleton);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    lowest = std::min({lowest, sole_height(body, skeleton, static_cast<int>(side)),
                       skeleton[on_side(Joint::kKneeLeft, side)].y() - knee_m});
  }
  return lowest;
}

template <class Change>
void for_each_point(Skeleton& skeleton, const Change& change) {
  for (auto& joint : skeleton.joints) change(joint);
  for (auto* points : {&skeleton.hand, &skeleton.fingertip, &skeleton.toe}) {
    for (auto& point : *points) change(point);
  }
  change(skeleton.head_top);
  change(skeleton.eye);
}

}  // namespace

Vector3d shoulder_offset_m(const BodyShape& body, const Vector3d& upper) {
  // Least squares over bodies D1-D3 of the rendered data (as a fraction of the stature); a body's
  // own gain and width vary about it.
  const double height = body.stature_m * body.scapula_gain;
  const Vector3d still(0.911 * body.shoulder_half_m, -body.shoulder_drop_m,
                       0.0041 * body.stature_m);
  Matrix3d motion;
  motion << 0.0035, -0.0041, 0.0102,  //
      0.0027, 0.0216, 0.0032,         //
      -0.0205, -0.0116, 0.0081;
  return still + height * motion * upper;
}

ArmPose reach(const BodyShape& body, const Vector3d& wrist_m, const Vector3d& pole) {
  ArmPose arm;
  arm.upper = (wrist_m - shoulder_offset_m(body, {0.2, -0.9, 0.2})).normalized();
  for (int i = 0; i < 4; ++i) {  // the shoulder moves with the arm: a few rounds settle below 1 mm
    const Vector3d shoulder = shoulder_offset_m(body, arm.upper);
    const Vector3d to_wrist = wrist_m - shoulder;
    const double a = body.upper_arm_m;
    const double b = body.forearm_m;
    const double distance = std::clamp(to_wrist.norm(), 0.35 * (a + b), 0.999 * (a + b));
    const Vector3d axis = to_wrist.normalized();
    const double along = (a * a - b * b + distance * distance) / (2.0 * distance);
    Vector3d side = pole - axis * axis.dot(pole);
    if (side.norm() < 1e-6) side = axis.unitOrthogonal();
    const Vector3d elbow =
        along * axis + std::sqrt(std::max(0.0, a * a - along * along)) * side.normalized();
    arm.upper = elbow.normalized();
    arm.fore = (distance * axis - elbow).normalized();
  }
  return arm;
}

double seat_height_m(const BodyShape& body, const Skeleton& skeleton) {
  return skeleton[Joint::kPelvis].y() - 0.055 * body.stature_m * body.hip_girth -
         0.5 * body.clothes.legs_m;
}

Skeleton make_skeleton(const BodyShape& body, const Posture& posture, const Place& place) {
  Skeleton skeleton;
  const Matrix3d level = about_y(3.14159265358979 + place.yaw_rad);
  skeleton.pelvis_R = level * about_x(posture.pelvis_lean_rad);
  skeleton[Joint::kPelvis] = Vector3d(place.x_m, 0.0, place.z_m);
  place_trunk(body, posture, skeleton);
  for (int side = 0; side < 2; ++side) {
    place_arm(body, posture.arms[side], side, skeleton);
    place_leg(body, posture.legs[side], side, level, skeleton);
  }
  const double ground = lowest_height(body, skeleton);
  for_each_point(skeleton, [ground](Vector3d& point) { point.y() -= ground; });
  return skeleton;
}

Skeleton transformed(const Skeleton& skeleton, const Eigen::Isometry3d& target_from_source) {
  Skeleton result = skeleton;
  for_each_point(result, [&](Vector3d& point) { point = target_from_source * point; });
  const Matrix3d rotation = target_from_source.linear();
  for (auto* frame : {&result.pelvis_R, &result.chest_R, &result.head_R, &result.hand_R[0],
                      &result.hand_R[1], &result.foot_R[0], &result.foot_R[1]}) {
    *frame = rotation * *frame;
  }
  return result;
}

double elbow_bend_rad(const Skeleton& skeleton, Side side) {
  const Vector3d& elbow = skeleton[on_side(Joint::kElbowLeft, side)];
  const Vector3d upper = (elbow - skeleton[on_side(Joint::kShoulderLeft, side)]).normalized();
  const Vector3d fore = (skeleton[on_side(Joint::kWristLeft, side)] - elbow).normalized();
  return std::acos(std::clamp(upper.dot(fore), -1.0, 1.0));
}

Vector3d arm_axis(const Skeleton& skeleton, Side side) {
  return (skeleton[on_side(Joint::kWristLeft, side)] -
          skeleton[on_side(Joint::kShoulderLeft, side)])
      .normalized();
}

}  // namespace limbcast::simulate
