#include "common/camera/pixel_rays.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace limbcast {
namespace {

TEST(PixelRays, GivesTheSamePointsAsTheCamera) {
  const PinholeCamera camera{19, 3, 521.3, 519.7, 9.2, 1.4};
  const PixelRays rays(camera);
  for (int v = 0; v < camera.height; ++v) {
    std::vector<float> z_m(camera.width);
    for (int u = 0; u < camera.width; ++u) z_m[u] = 0.3F * static_cast<float>(u) + 0.7F;
    std::vector<Eigen::Vector3f> points_m(camera.width);
    rays.back_project_row(v, z_m.data(), points_m.data());
    for (int u = 0; u < camera.width; ++u)
      EXPECT_EQ(points_m[u],
                camera.back_project(static_cast<float>(u), static_cast<float>(v), z_m[u]));
  }
}

TEST(PixelRays, PutsHolesAtTheOrigin) {
  const PixelRays rays({1, 1, 500.0, 500.0, 9.0, 9.0});
  const float hole = 0.0F;
  Eigen::Vector3f point_m;
  rays.back_project_row(0, &hole, &point_m);
  for (const float coordinate_m : point_m) EXPECT_FALSE(std::signbit(coordinate_m));
  EXPECT_EQ(point_m, Eigen::Vector3f::Zero());
}

}  // namespace
}  // namespace limbcast
