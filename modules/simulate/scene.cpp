#include "modules/simulate/scene.hpp"

#include <algorithm>
#include <cmath>

namespace limbcast::simulate {
namespace {

using Eigen::Vector3d;

}  // namespace

Solid& SceneBuilder::box(const Vector3d& center, const Vector3d& size, double yaw_rad,
                         const Material& material) {
  Solid solid;
  solid.frame_from_solid.translation() = center.cast<float>();
  solid.frame_from_solid.linear() =
      Eigen::AngleAxisf(static_cast<float>(yaw_rad), Eigen::Vector3f::UnitY()).toRotationMatrix();
  solid.half_m = (0.5 * size).cast<float>();
  solid.material = material;
  world_.solids.push_back(solid);
  return world_.solids.back();
}

Solid& SceneBuilder::round(Solid::Kind kind, const Vector3d& center, const Vector3d& half,
                           const Material& material) {
  Solid& solid = box(center, 2.0 * half, 0.0, material);
  solid.kind = kind;
  return solid;
}

Material SceneBuilder::even(Bgr color, float grain) {
  Material material;
  material.color = material.second = color;
  material.grain = grain;
  return material;
}

Material SceneBuilder::wood() {
  const double tone = rng_.uniform(0.5, 1.1);
  const auto byte = [&](double value) {
    return static_cast<std::uint8_t>(std::min(255.0, value * tone));
  };
  Material material = even({byte(105), byte(150), byte(190)}, 0.15F);
  material.second = {byte(70), byte(110), byte(150)};
  material.pattern = Pattern::kWood;
  material.scale_m = 0.04F;
  return material;
}

Material SceneBuilder::some_material() {
  if (rng_.chance(0.35)) return wood();
  const double grey = rng_.uniform(40, 230);
  const double purity = rng_.uniform(0.0, 0.8);
  const auto byte = [&] {
    return static_cast<std::uint8_t>(grey + purity * (rng_.uniform(20, 235) - grey));
  };
  const auto grain = static_cast<float>(rng_.uniform(0.0, 0.2));
  Material material = even({byte(), byte(), byte()}, grain);
  material.second = {byte(), byte(), byte()};
  if (rng_.chance(0.3)) material.pattern = static_cast<Pattern>(1 + rng_.pick(3));
  material.scale_m = static_cast<float>(rng_.uniform(0.04, 0.3));
  return material;
}

void SceneBuilder::room(const std::vector<Circle>& keep_free) {
  Material floor = rng_.chance(0.4) ? wood() : some_material();
  floor.scale_m = static_cast<float>(rng_.uniform(0.05, 0.25));
  box({0, -0.05, 10}, {80, 0.1, 80}, 0.0, floor);
  if (rng_.chance(0.25)) {  // a yard
    const double far = rng_.uniform(8, 15);
    const Material house = some_material();
    box({0, 3, far + 1.0}, {30, 6, 2}, rng_.normal(0.0, 0.15), house);
    for (int i = rng_.pick(4); i > 0; --i) {
      const double x = rng_.uniform(-5, 5);
      const double z = rng_.uniform(5.5, far);
      round(Solid::Kind::kCylinder, {x, 1.2, z}, {0.15, 1.2, 0.15}, wood());
      round(Solid::Kind::kEllipsoid, {x, 3.0, z}, {1.0, 0.9, 1.0}, some_material());
    }
    return;
  }
  double back = rng_.uniform(4.8, 8.5);
  double half = rng_.uniform(2.2, 4.5);
  if (rng_.chance(0.85)) {
    for (const Circle& circle : keep_free) {
      back = std::max(back, circle.z_m + circle.radius_m + 0.4);
      half = std::max(half, std::abs(circle.x_m) + circle.radius_m + 0.4);
    }
  }
  const double height = rng_.uniform(2.3, 3.2);
  const double yaw = rng_.normal(0.0, 0.12);
  const Eigen::AngleAxisd turn(yaw, Vector3d::UnitY());
  Material wall = some_material();
  wall.grain = static_cast<float>(rng_.uniform(0.0, 0.12));
  box(turn * Vector3d(0, height / 2, back + 0.05), {2 * half + 2, height, 0.1}, yaw, wall);
  box(turn * Vector3d(half + 0.05, height / 2, back / 2), {0.1, height, 2 * back}, yaw, wall);
  box(turn * Vector3d(-half - 0.05, height / 2, back / 2), {0.1, height, 2 * back}, yaw, wall);
  box({0, height + 0.05, 3}, {20, 0.1, 20}, 0.0, even({200, 205, 210}, 0.03F));
  for (int i = rng_.pick(4); i > 0; --i) {  // pictures and windows
    Material picture = some_material();
    picture.pattern = Pattern::kPicture;
    picture.scale_m = static_cast<float>(rng_.uniform(0.1, 0.5));
    const Vector3d size{rng_.uniform(0.3, 1.2), rng_.uniform(0.3, 1.2), 0.03};
    const double y = rng_.uniform(1.1, 1.8);
    const double x = rng_.uniform(-half, half);
    box(turn * Vector3d(x, y, back - 0.01), size, yaw, picture);
  }
}

bool SceneBuilder::find_place(const std::vector<Circle>& keep_free, double radius_m, double& x_m,
                              double& z_m, double from_m, double to_m, double slope) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    z_m = rng_.uniform(from_m, to_m);
    x_m = rng_.uniform(-slope, slope) * (z_m + 0.5);
    const bool free = std::none_of(keep_free.begin(), keep_free.end(), [&](const Circle& circle) {
      return std::hypot(circle.x_m - x_m, circle.z_m - z_m) < circle.radius_m + radius_m;
    });
    if (free) return true;
  }
  return false;
}

void SceneBuilder::furniture(int count, const std::vector<Circle>& keep_free) {
  for (int i = 0; i < count; ++i) {
    double x = 0.0;
    double z = 0.0;
    if (!find_place(keep_free, 0.5, x, z)) continue;
    switch (rng_.pick(7)) {
      case 0:
        table(x, z);
        break;
      case 1: {
        const double seat_height = rng_.uniform(0.40, 0.50);
        chair(x, z, rng_.uniform(-3.1, 3.1), seat_height, 0.42);
        break;
      }
      case 2: {
        const double seat_height = rng_.uniform(0.38, 0.45);
        sofa(x, z + 0.3, rng_.normal(3.14, 0.6), seat_height);
        break;
      }
      case 3:
        shelf(x, z);
        break;
      case 4:
        plant(x, z);
        break;
      case 5:
        lamp(x, z);
        break;
      default:
        boxes(x, z);
        break;
    }
  }
}

void SceneBuilder::table(double x, double z) {
  const Material material = some_material();
  const double yaw = rng_.uniform(-1.6, 1.6);
  const double width = rng_.uniform(0.6, 1.5);
  const double depth = rng_.uniform(0.5, 0.8);
  const double height = rng_.uniform(0.45, 0.78);
  const Eigen::AngleAxisd turn(yaw, Vector3d::UnitY());
  const Vector3d at(x, 0, z);
  box(at + Vector3d(0, height, 0), {width, 0.04, depth}, yaw, material);
  for (const double sx : {-1.0, 1.0}) {
    for (const double sz : {-1.0, 1.0}) {
      box(at + turn * Vector3d(sx * (width / 2 - 0.04), height / 2, sz * (depth / 2 - 0.04)),
          {0.05, height, 0.05}, yaw, material);
    }
  }
  if (rng_.chance(0.4)) {
    box(at + Vector3d(0, height + 0.15, 0), {0.35, 0.3, 0.2}, yaw + 0.3, some_material());
  }
}

void SceneBuilder::chair(double x, double z, double yaw_rad, double seat_height_m, double width_m) {
  const Material material = some_material();
  const Eigen::AngleAxisd turn(yaw_rad, Vector3d::UnitY());  // z of the chair is where one looks
  const Vector3d at(x, 0, z);
  const double half = width_m / 2;
  box(at + Vector3d(0, seat_height_m - 0.02, 0), {width_m, 0.04, width_m}, yaw_rad, material);
  for (const double sx : {-1.0, 1.0}) {
    for (const double sz : {-1.0, 1.0}) {
      box(at + turn * Vector3d(sx * (half - 0.02), seat_height_m / 2, sz * (half - 0.02)),
          {0.035, seat_height_m, 0.035}, yaw_rad, material);
    }
    box(at + turn * Vector3d(sx * (half - 0.02), seat_height_m + 0.22, -half), {0.035, 0.48, 0.035},
        yaw_rad, material);
  }
  box(at + turn * Vector3d(0, seat_height_m + 0.36, -half), {width_m, 0.2, 0.025}, yaw_rad,
      material);
}

void SceneBuilder::sofa(double x, double z, double yaw_rad, double seat_height_m) {
  const Material material = some_material();
  const Eigen::AngleAxisd turn(yaw_rad, Vector3d::UnitY());
  const Vector3d at(x, 0, z);
  const double width = rng_.uniform(0.8, 2.0);
  box(at + turn * Vector3d(0, seat_height_m / 2, 0), {width, seat_height_m, 0.65}, yaw_rad,
      material);
  box(at + turn * Vector3d(0, 0.45, -0.42), {width, 0.9, 0.2}, yaw_rad, material);
  for (const double side : {-1.0, 1.0}) {
    box(at + turn * Vector3d(side * (width / 2 + 0.08), 0.3, -0.05), {0.16, 0.6, 0.75}, yaw_rad,
        material);
  }
}

void SceneBuilder::shelf(double x, double z) {
  const Material material = some_material();
  const double yaw = rng_.normal(0.0, 0.3);
  const double height = rng_.uniform(0.8, 2.1);
  box({x, height / 2, z}, {rng_.uniform(0.4, 1.0), height, rng_.uniform(0.25, 0.45)}, yaw,
      material);
}

void SceneBuilder::plant(double x, double z) {
  const double height = rng_.uniform(0.3, 1.3);
  round(Solid::Kind::kCylinder, {x, 0.15, z}, {0.15, 0.15, 0.15}, some_material());
  round(Solid::Kind::kCylinder, {x, height / 2, z}, {0.02, height / 2, 0.02}, wood());
  for (int i = 0; i < 4; ++i) {
    const double radius = rng_.uniform(0.12, 0.25);
    Material leaves = even({40, static_cast<std::uint8_t>(rng_.uniform(70, 130)), 50}, 0.4F);
    round(Solid::Kind::kEllipsoid,
          {x + rng_.normal(0, 0.1), height + rng_.normal(0.1, 0.12), z + rng_.normal(0, 0.1)},
          {radius, 0.8 * radius, radius}, leaves);
  }
}

void SceneBuilder::lamp(double x, double z) {
  const double height = rng_.uniform(1.3, 1.8);
  round(Solid::Kind::kCylinder, {x, height / 2, z}, {0.015, height / 2, 0.015}, some_material());
  round(Solid::Kind::kCylinder, {x, 0.015, z}, {0.15, 0.015, 0.15}, some_material());
  const double shade = rng_.uniform(0.09, 0.22);
  const Material material = some_material();
  const Vector3d half{shade, rng_.uniform(0.1, 0.18), shade};
  round(rng_.chance(0.5) ? Solid::Kind::kCylinder : Solid::Kind::kEllipsoid, {x, height, z}, half,
        material);
}

void SceneBuilder::boxes(double x, double z) {
  double top = 0.0;
  for (int i = 1 + rng_.pick(3); i > 0; --i) {
    const double depth = rng_.uniform(0.25, 0.6);
    const double height = rng_.uniform(0.2, 0.6);
    const double width = rng_.uniform(0.25, 0.6);
    const Material material = some_material();
    const double yaw = rng_.uniform(-1, 1);
    box({x + rng_.normal(0, 0.03), top + height / 2, z}, {width, height, depth}, yaw, material);
    top += height;
  }
}

}  // namespace limbcast::simulate
