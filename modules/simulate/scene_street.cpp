#include <algorithm>

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
    const double radius = kind < 0.9 ? 0.4 : 1.5;
    if (!find_place(keep_free, radius, x, z, kFromM, kToM, kSlope)) continue;
    if (kind < 0.4) {
      trunk(x, z);
    } else if (kind < 0.7) {
      pole(x, z);
    } else if (kind < 0.9) {
      bush(x, z);
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
  if (rng_.chance(0.5)) {  // a sign, or the box of a lamp
    const double at = rng_.uniform(0.7, std::min(2.4, height));
    const Material material = some_material();
    const double yaw = rng_.uniform(-1.6, 1.6);
    box({x, at, z}, {rng_.uniform(0.15, 0.7), rng_.uniform(0.15, 0.7), rng_.uniform(0.03, 0.3)},
        yaw, material);
  }
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
  const Material paint = some_material();
  const double yaw = rng_.chance(0.5) ? rng_.normal(0.0, 0.1) : rng_.normal(1.57, 0.1);
  const double length = rng_.uniform(3.6, 4.8);
  box({x, 0.6, z}, {length, 0.7, 1.75}, yaw, paint);
  box({x, 1.2, z}, {0.5 * length, 0.55, 1.5}, yaw, paint);
}

}  // namespace limbcast::simulate
