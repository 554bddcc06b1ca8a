#include "modules/simulate/raycast.hpp"

#include <gtest/gtest.h>

namespace limbcast::simulate {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

Hit hit_along(const World& world, const Vector3f& direction) {
  RayGrid ray;
  ray.width = ray.height = 1;
  Vector3f unit = direction.normalized();
  ray.direction = [unit](int, int) { return unit; };
  return raycast(world, ray).at(0, 0);
}

Surface ball_at(const Vector3d& center, double radius_m) {
  SurfaceBuilder builder({Material{}});
  builder.begin_group(0.01);
  builder.as(Part::kTrunk, 0);
  builder.ball(center, radius_m);
  return std::move(builder).build(1);
}

TEST(Raycast, MeetsABallOneRadiusBeforeItsCentre) {
  World world;
  world.surfaces.push_back(ball_at({0, 0, 3}, 0.5));

  const Hit hit = hit_along(world, {0, 0, 1});

  EXPECT_NEAR(hit.range_m, 2.5F, 0.001F);
  EXPECT_EQ(person_of(world, hit), 1);
  EXPECT_EQ(part_of(world, hit), Part::kTrunk);
  EXPECT_NEAR((normal_at(world, hit, {0, 0, hit.range_m}) - Vector3f(0, 0, -1)).norm(), 0.0F,
              0.01F);
}

TEST(Raycast, MissesABallBesideTheRay) {
  World world;
  world.surfaces.push_back(ball_at({0.6, 0, 3}, 0.5));

  EXPECT_FALSE(hit_along(world, {0, 0, 1}));
}

TEST(Raycast, MeetsTheNearestOfTwoThings) {
  World world;
  world.surfaces.push_back(ball_at({0, 0, 3}, 0.5));
  Solid wall;
  wall.half_m = {2, 2, 0.1F};
  wall.frame_from_solid.translation() = Vector3f(0, 0, 2);
  world.solids.push_back(wall);

  const Hit hit = hit_along(world, {0, 0, 1});

  EXPECT_NEAR(hit.range_m, 1.9F, 1e-5F);
  EXPECT_EQ(hit.solid, 0);
  EXPECT_EQ(person_of(world, hit), 0);
}

TEST(Raycast, MeetsTheFlankOfACylinderAndItsLid) {
  World world;
  Solid post;
  post.kind = Solid::Kind::kCylinder;
  post.half_m = {0.2F, 0.5F, 0.2F};
  post.frame_from_solid.translation() = Vector3f(0, 0, 2);
  world.solids.push_back(post);

  EXPECT_NEAR(hit_along(world, {0, 0, 1}).range_m, 1.8F, 1e-5F);

  world.solids[0].frame_from_solid.translation() = Vector3f(0, 2, 0);
  EXPECT_NEAR(hit_along(world, {0, 1, 0}).range_m, 1.5F, 1e-5F);
}

TEST(Raycast, MeetsAnEllipsoidAtItsHalfAxis) {
  World world;
  Solid egg;
  egg.kind = Solid::Kind::kEllipsoid;
  egg.half_m = {0.2F, 0.3F, 0.4F};
  egg.frame_from_solid.translation() = Vector3f(0, 0, 2);
  world.solids.push_back(egg);

  EXPECT_NEAR(hit_along(world, {0, 0, 1}).range_m, 1.6F, 1e-5F);
}

TEST(Surface, StretchedConesNeverTellMoreThanTheTrueDistance) {
  SurfaceBuilder builder({Material{}});
  builder.begin_group(0.01);
  builder.cone({0, 0, 0}, {0, 1, 0}, 0.1, 0.1, Vector3d::UnitX(), 2.0);
  const Surface surface = std::move(builder).build(0);

  EXPECT_NEAR(surface.distance_m({0.2F, 0.5F, 0.0F}), 0.0F, 1e-5F);  // twice as wide along x
  EXPECT_NEAR(surface.distance_m({0.0F, 0.5F, 0.3F}), 0.2F, 1e-5F);
  EXPECT_LE(surface.distance_m({1.2F, 0.5F, 0.0F}), 1.0F);
  EXPECT_GT(surface.distance_m({1.2F, 0.5F, 0.0F}), 0.0F);
}

}  // namespace
}  // namespace limbcast::simulate
