#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/simulate/scene.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Vector3d;

}  // namespace

void SceneBuilder::seat(const BodyShape& body, const Skeleton& skeleton) {
  const Vector3d pelvis = skeleton[Joint::kPelvis];
  const Vector3d forward = skeleton.pelvis_R.col(2);
  const double yaw = std::atan2(forward.x(), forward.z());
  const double top = std::max(0.12, seat_height_m(body, skeleton));
  const Vector3d at = pelvis + 0.06 * forward;
  const double kind = rng_.uniform();
  if (kind < 0.5) {
    chair(at.x(), at.z(), yaw, top, 0.44);
  } else if (kind < 0.8) {
    sofa(at.x(), at.z(), yaw, top);
  } else {
    round(Solid::Kind::kCylinder, {at.x(), top / 2, at.z()}, {0.18, top / 2, 0.18},
          some_material());
  }
}

void SceneBuilder::carried(const Skeleton& skeleton) {
  const Vector3d span = skeleton.hand[0] - skeleton.hand[1];
  const Vector3d middle =
      0.5 * (skeleton.hand[0] + skeleton.hand[1]) + 0.06 * skeleton.chest_R.col(2);
  const double width = std::max(0.08, std::hypot(span.x(), span.z()) - 0.05);
  const Material material = some_material();
  box(middle + Vector3d(0, 0.04, 0), {width, rng_.uniform(0.06, 0.35), rng_.uniform(0.12, 0.3)},
      std::atan2(-span.z(), span.x()), material);
}

void SceneBuilder::held(const HeldThing& thing, const Skeleton& skeleton) {
  const Vector3d middle = skeleton[Joint::kNeck] + skeleton.chest_R * thing.middle_m;
  Solid& solid = box(middle, thing.size_m, 0.0, some_material());
  const Eigen::AngleAxisd tilt(thing.tilt_rad, Vector3d::UnitX());
  solid.frame_from_solid.linear() = (skeleton.chest_R * tilt).cast<float>();
}

void SceneBuilder::occluder(const Place& place) {
  const double share = rng_.uniform(0.45, 0.85);  // of the way from the camera
  const double x = share * place.x_m + rng_.normal(0.0, 0.35);
  const double z = share * place.z_m;
  switch (rng_.pick(5)) {
    case 0:
      table(x, z);
      break;
    case 1:
      chair(x, z, rng_.uniform(-3.1, 3.1), 0.45, 0.42);
      break;
    case 2:
      plant(x + (rng_.chance(0.5) ? 0.4 : -0.4), z);
      break;
    case 3:
      boxes(x, z);
      break;
    default: {  // a pillar or a door's edge
      const Material material = some_material();
      round(Solid::Kind::kCylinder, {x + (rng_.chance(0.5) ? 0.3 : -0.3), 1.3, z},
            {0.07, 1.3, 0.07}, material);
    }
  }
}

void SceneBuilder::lookalikes(int count, const std::vector<Circle>& keep_free) {
  for (int i = 0; i < count; ++i) {
    double x = 0.0;
    double z = 0.0;
    if (!find_place(keep_free, 0.4, x, z)) continue;
    switch (rng_.pick(3)) {
      case 0:
        ball_on_pillar(x, z);
        break;
      case 1:
        coat_stand(x, z);
        break;
      default:
        box_figure(x, z);
        break;
    }
  }
}

void SceneBuilder::ball_on_pillar(double x, double z) {
  const double height = rng_.uniform(0.7, 1.6);
  const double width = rng_.uniform(0.03, 0.25);
  const double radius = rng_.uniform(0.08, 0.17);
  if (rng_.chance(0.5)) {
    const Material material = some_material();
    const double yaw = rng_.uniform(-1, 1);
    box({x, height / 2, z}, {2 * width, height, rng_.uniform(0.1, 0.4)}, yaw, material);
  } else {
    round(Solid::Kind::kCylinder, {x, height / 2, z}, {width, height / 2, width}, some_material());
  }
  const Material ball = some_material();
  round(Solid::Kind::kEllipsoid, {x, height + 0.9 * radius, z},
        {radius, radius * rng_.uniform(0.9, 1.4), radius}, ball);
}

void SceneBuilder::coat_stand(double x, double z) {
  const double height = rng_.uniform(1.4, 1.9);
  round(Solid::Kind::kCylinder, {x, height / 2, z}, {0.02, height / 2, 0.02}, wood());
  round(Solid::Kind::kCylinder, {x, 0.02, z}, {0.2, 0.02, 0.2}, wood());
  SurfaceBuilder builder({some_material(), some_material()});
  builder.begin_group(0.05);
  const double yaw = rng_.uniform(0.0, 6.28);
  const Vector3d wide(std::cos(yaw), 0, std::sin(yaw));
  const Vector3d hook(x, height - 0.08, z);
  builder.as(Part::kNone, 0, 0.006);
  const Vector3d front(-wide.z(), 0, wide.x());
  for (const double side : {-1.0, 1.0}) {  // shoulders and empty sleeves, flatter than a body
    const Vector3d shoulder =
        hook + side * rng_.uniform(0.10, 0.2) * wide - Vector3d(0, 0.1, 0) + 0.05 * front;
    builder.cone(hook + 0.05 * front, shoulder, 0.03, 0.05);
    builder.cone(shoulder, shoulder - Vector3d(0, rng_.uniform(0.4, 0.6), 0) + 0.05 * side * wide,
                 0.05, 0.04);
  }
  builder.cone(hook + 0.05 * front - Vector3d(0, 0.15, 0),
               hook + 0.06 * front - Vector3d(0, rng_.uniform(0.6, 1.0), 0), 0.07, 0.09, wide, 1.7);
  if (rng_.chance(0.4)) {  // a hat on top
    builder.begin_group(0.02);
    builder.as(Part::kNone, 1);
    builder.ellipsoid(hook + Vector3d(0, 0.1, 0), Eigen::Matrix3d::Identity(), {0.09, 0.06, 0.1});
    builder.ellipsoid(hook + Vector3d(0, 0.07, 0), Eigen::Matrix3d::Identity(),
                      {0.16, 0.018, 0.17});
  }
  world_.surfaces.push_back(std::move(builder).build(0));
}

void SceneBuilder::box_figure(double x, double z) {
  const double yaw = rng_.uniform(-1.0, 1.0);
  const Eigen::AngleAxisd turn(yaw, Vector3d::UnitY());
  const Vector3d at(x, 0, z);
  const Material material = some_material();
  const double hip = rng_.uniform(0.4, 0.9);
  const double trunk = rng_.uniform(0.4, 0.65);
  const Material legs = rng_.chance(0.5) ? material : some_material();
  box(at + Vector3d(0, hip / 2, 0), {rng_.uniform(0.15, 0.5), hip, 0.3}, yaw, legs);
  box(at + Vector3d(0, hip + trunk / 2, 0),
      {rng_.uniform(0.3, 0.6), trunk, rng_.uniform(0.2, 0.35)}, yaw, material);
  if (rng_.chance(0.5)) {
    round(Solid::Kind::kEllipsoid, at + Vector3d(0, hip + trunk + 0.12, 0), {0.13, 0.14, 0.13},
          some_material());
  } else {
    const double cube = rng_.uniform(0.15, 0.35);
    box(at + Vector3d(0, hip + trunk + cube / 2, 0), {cube, cube, cube}, yaw + 0.3,
        some_material());
  }
  if (rng_.chance(0.4)) {  // a beam that looks like an arm
    box(at + turn * Vector3d(0.35, hip + 0.8 * trunk, 0), {0.7, 0.08, 0.08}, yaw, material);
  }
}

}  // namespace limbcast::simulate
