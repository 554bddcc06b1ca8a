#include <algorithm>
#include <cmath>

#include "common/shortest_turn.hpp"
#include "common/units.hpp"
#include "modules/simulate/scene.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Vector3d;

/// Where things of a street stand: as far as people are found in scans.
constexpr double kFromM = 1.8, kToM = 12.0, kSlope = 0.8;

}  // namespace

void SceneBuilder::street(const std::vector<Circle>& keep_free) {
  box({0, -0.05, 10}, {80, 0.1, 80}, 0.0, some_material());
  const double far = rng_.uniform(9, 20);
  const Material house = some_material();
  const double yaw = rng_.normal(0.0, 0.2);
  const double width = rng_.uniform(8, 40);
  box({rng_.normal(0.0, 8.0), 4, far + 4.0}, {width, 8, 2}, yaw, house);
  for (int i = 5 + rng_.pick(8); i > 0; --i) {
    const double kind = rng_.uniform();
    double x = 0.0;
    double z = 0.0;
    const double radius = kind < 0.8 ? 0.4 : 2.2;
    if (!find_place(keep_free, radius, x, z, kFromM, kToM, kSlope)) continue;
    if (kind < 0.25) {
      trunk(x, z);
    } else if (kind < 0.5) {
      pole(x, z);
    } else if (kind < 0.65) {
      bush(x, z);
    } else if (kind < 0.72) {
      bin(x, z);
    } else if (kind < 0.8) {
      bicycle(x, z);
    } else {
      car(x, z);
    }
  }
}

void SceneBuilder::trunk(double x, double z) {
  const double radius = rng_.uniform(0.07, 0.28);
  const double height = rng_.uniform(1.8, 5.0);
  const Material bark = wood();
  round(Solid::Kind::kCylinder, {x, height / 2, z}, {radius, height / 2, radius}, bark);
  for (int i = rng_.pick(7); i > 0; --i) {  // branches, and a stake that leans on the trunk
    const double half = rng_.uniform(0.2, 0.9);
    const double thick = rng_.uniform(0.015, 0.07);
    const Eigen::AngleAxisd turn(rng_.uniform(-kPi<double>, kPi<double>), Vector3d::UnitY());
    const Eigen::AngleAxisd tilt(rng_.uniform(0.2, 1.3), Vector3d::UnitX());
    const Vector3d axis = turn * tilt * Vector3d::UnitY();
    Solid& branch =
        round(Solid::Kind::kCylinder, Vector3d(x, rng_.uniform(0.5, height), z) + half * axis,
              {thick, half, thick}, bark);
    branch.frame_from_solid.linear() = (turn * tilt).toRotationMatrix().cast<float>();
  }
  for (int i = rng_.pick(4); i > 0; --i) {
    const double at = rng_.chance(0.4) ? rng_.uniform(0.8, height) : height;
    const double spread = rng_.uniform(0.2, 0.7);
    foliage({x + rng_.normal(0, 0.3), at, z + rng_.normal(0, 0.3)}, spread);
  }
}

void SceneBuilder::foliage(const Vector3d& center, double spread_m) {
  const Material leaves = some_material();
  for (int i = 10 + rng_.pick(30); i > 0; --i) {
    const double radius = rng_.uniform(0.02, 0.12);
    const double z = rng_.normal();
    const double y = rng_.normal();
    const Vector3d offset(rng_.normal(), y, z);
    round(Solid::Kind::kEllipsoid, center + 0.6 * spread_m * offset, {radius, 0.7 * radius, radius},
          leaves);
  }
}

void SceneBuilder::pole(double x, double z) {
  const double radius = rng_.uniform(0.03, 0.12);
  const double height = rng_.chance(0.3) ? rng_.uniform(0.8, 1.3) : rng_.uniform(2.0, 6.0);
  round(Solid::Kind::kCylinder, {x, height / 2, z}, {radius, height / 2, radius}, some_material());
  for (int i = rng_.pick(4); i > 0; --i) {  // signs, and the boxes of lamps
    const Vector3d at(x, rng_.uniform(0.7, std::min(2.6, height)), z);
    const double yaw = rng_.uniform(-1.6, 1.6);
    const double depth = rng_.uniform(0.03, 0.3);
    const double height_of_sign = rng_.uniform(0.15, 0.9);
    const Vector3d size(rng_.uniform(0.15, 0.7), height_of_sign, depth);
    if (rng_.chance(0.6)) {
      box(at, size, yaw, some_material());
    } else {
      disc(at, 0.5 * size.x(), 0.02, yaw);
    }
  }
}

void SceneBuilder::disc(const Vector3d& center, double radius_m, double half_width_m,
                        double yaw_rad) {
  Solid& solid =
      round(Solid::Kind::kCylinder, center, {radius_m, half_width_m, radius_m}, some_material());
  solid.frame_from_solid.linear() = (Eigen::AngleAxisd(yaw_rad, Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(kPi<double> / 2, Vector3d::UnitX()))
                                        .toRotationMatrix()
                                        .cast<float>();
}

void SceneBuilder::bin(double x, double z) {
  const double half = rng_.uniform(0.15, 0.35);
  const double height = rng_.uniform(0.3, 1.1);
  const double top = rng_.uniform(height, 1.4);  // above the ground: on a post
  const double yaw = rng_.uniform(-1.6, 1.6);
  const Material material = some_material();
  const Vector3d at(x, top - height / 2, z);
  if (rng_.chance(0.5)) {
    box(at, {2 * half, height, 2 * half}, yaw, material);
  } else {
    round(Solid::Kind::kCylinder, at, {half, height / 2, half}, material);
  }
  box({x, top / 2, z}, {0.06, top, 0.06}, yaw, material);
}

SceneBuilder::Placed SceneBuilder::placed(double x, double z, double yaw_rad) {
  return {*this, {x, 0, z}, yaw_rad, some_material()};
}

void SceneBuilder::Placed::bar(const Vector3d& from, const Vector3d& to, double thick_m) const {
  const Vector3d along = to - from;
  const double length = along.norm();
  Solid& solid = scene.box(world(0.5 * (from + to)), {length, thick_m, thick_m}, yaw_rad, material);
  const Eigen::Quaterniond tilt = shortest_turn<double>(Vector3d::UnitX(), along);
  solid.frame_from_solid.linear() = (turn() * tilt).toRotationMatrix().cast<float>();
}

void SceneBuilder::bicycle(double x, double z) {
  constexpr int kRimParts = 10;
  constexpr double kWheelM = 0.33, kHalfBaseM = 0.52;
  const Placed bicycle = placed(x, z, rng_.uniform(-kPi<double>, kPi<double>));
  for (const double center : {-kHalfBaseM, kHalfBaseM}) {
    const auto rim = [&](int part) {
      const double angle = 2 * kPi<double> * part / kRimParts;
      return Vector3d(center + kWheelM * std::cos(angle), kWheelM * (1.0 + std::sin(angle)), 0);
    };
    for (int part = 0; part < kRimParts; ++part) bicycle.bar(rim(part), rim(part + 1), 0.04);
  }
  const Vector3d saddle(-0.2, 0.95, 0), handlebar(0.4, 1.0, 0), pedals(-0.05, 0.3, 0);
  bicycle.bar({-kHalfBaseM, kWheelM, 0}, saddle, 0.03);
  bicycle.bar({kHalfBaseM, kWheelM, 0}, handlebar, 0.04);
  bicycle.bar(saddle, pedals, 0.04);
  bicycle.bar(pedals, handlebar, 0.04);
  bicycle.bar(saddle, handlebar, 0.04);
  bicycle.bar(handlebar + Vector3d(0, 0, -0.28), handlebar + Vector3d(0, 0, 0.28), 0.04);
  bicycle.box(saddle, {0.25, 0.08, 0.15});
}

void SceneBuilder::bush(double x, double z) {
  for (int i = 1 + rng_.pick(5); i > 0; --i) {
    const double at_z = z + rng_.normal(0, 0.2);
    const double at_y = rng_.uniform(0.1, 1.5);
    const Vector3d at(x + rng_.normal(0, 0.2), at_y, at_z);
    const double radius = rng_.uniform(0.1, 0.4);
    if (rng_.chance(0.5)) {
      foliage(at, radius);
    } else {
      const Material leaves = some_material();
      round(Solid::Kind::kEllipsoid, at, {radius, rng_.uniform(0.7, 1.3) * radius, radius}, leaves);
    }
  }
}

void SceneBuilder::car(double x, double z) {
  const double along = rng_.chance(0.5) ? 0.0 : kPi<double> / 2;
  const Placed car = placed(x, z, along + rng_.normal(0.0, 0.1));
  const double length = rng_.uniform(3.6, 4.8);
  const double width = rng_.uniform(1.65, 1.9);
  const double hood = rng_.uniform(0.7, 0.9);
  for (const double side : {-1.0, 1.0}) {
    for (const double end : {-0.3, 0.3})
      disc(car.world({end * length, 0.31, side * (0.5 * width - 0.1)}), 0.31, 0.11, car.yaw_rad);
  }
  if (rng_.chance(0.2)) {  // a van
    const double height = rng_.uniform(1.7, 2.3);
    car.box({-0.1 * length, 0.25 + height / 2, 0}, {0.8 * length, height, width});
    car.box({0, 0.25 + hood / 2, 0}, {length, hood, width});
    return;
  }
  const double belt = hood + rng_.uniform(0.0, 0.2);
  car.box({0, 0.5 * (0.25 + hood), 0}, {length, hood - 0.25, width});
  car.box({-0.1 * length, 0.5 * (0.25 + belt), 0}, {0.75 * length, belt - 0.25, width});
  cabin(car, {length, belt, width});
}

void SceneBuilder::cabin(const Placed& car, const Vector3d& size) {
  const double belt = size.y();
  const double roof = belt + rng_.uniform(0.45, 0.7);
  const double half_across = 0.5 * size.z() - 0.15;
  const double front = rng_.uniform(0.0, 0.1) * size.x();  // of the roof
  const double back = -rng_.uniform(0.3, 0.45) * size.x();
  car.box({0.5 * (front + back), roof, 0}, {front - back, 0.06, 2 * half_across});
  if (rng_.chance(0.25)) {  // panes that mirror
    car.box({0.5 * (front + back), 0.5 * (belt + roof), 0},
            {front - back, roof - belt, 2 * half_across});
    return;
  }
  const double thick = rng_.uniform(0.05, 0.12);
  const double windscreen = front + rng_.uniform(0.5, 0.9) * (roof - belt);
  for (const double side : {-half_across, half_across}) {
    car.bar({windscreen, belt, side}, {front, roof, side}, thick);
    car.bar({0.5 * (front + back), belt, side}, {0.5 * (front + back), roof, side}, thick);
    car.bar({back - rng_.uniform(0.0, 0.5), belt, side}, {back, roof, side}, 1.5 * thick);
    const Vector3d mirror(windscreen - 0.1, belt + 0.1, 1.3 * side);
    car.box(mirror, {0.1, 0.14, 0.2});
    for (const double at : {0.35 * front + 0.65 * back, 0.9 * front + 0.1 * back}) {
      const Vector3d seat(at, belt - 0.2, 0.5 * side);  // with its head restraint
      const Vector3d top = seat + Vector3d(-0.15, rng_.uniform(0.35, 0.5), 0);
      car.bar(seat, top, 0.35);
      round(Solid::Kind::kEllipsoid, car.world(top + Vector3d(0, 0.1, 0)), {0.1, 0.1, 0.12},
            car.material);
    }
  }
}

}  // namespace limbcast::simulate
