#include "modules/reconstructor/ground_lean.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limbcast::reconstructor {
namespace {

constexpr double kFocalBaseline_px_m = 30.0;

/// Of a right camera that turned the offset of disparities grows towards the image's sides.
enum class Offset { kEven, kOfATurn };

/// The floor that a camera sees which stands 1.2 m over it and looks 0.2 rad down, with all
/// disparities too large by `offset_px`, and a wall 6 m away.
Cloud floor_seen_with(double offset_px, Offset kind = Offset::kEven) {
  Cloud cloud;
  const PinholeCamera camera{160, 120, 130.0, 130.0, 79.5, 59.5};
  cloud.camera = camera;
  cloud.width = camera.width;
  cloud.height = camera.height;
  const double pitch_rad = 0.2, height_m = 1.2, wall_m = 6.0;
  const Eigen::Vector3d down(0.0, std::cos(pitch_rad), std::sin(pitch_rad));
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const Eigen::Vector3d ray = camera.back_project(u, v, 1.0F).cast<double>();
      const double nearness = std::max(1.0 / wall_m, down.dot(ray) / height_m);
      const double grown = kind == Offset::kEven ? 1.0 : 1.0 + ray.x() * ray.x();
      const double disparity_px = kFocalBaseline_px_m * nearness + offset_px * grown;
      cloud.points_m.push_back(
          camera.back_project(u, v, static_cast<float>(kFocalBaseline_px_m / disparity_px)));
    }
  }
  cloud.stamp.gravity.down = down.cast<float>();
  cloud.stamp.gravity.source = GravitySource::kRecording;
  return cloud;
}

TEST(GroundLean, TellsByHowMuchAllDisparitiesAreOff) {
  for (const double offset_px : {-1.0, 0.0, 0.5, 1.5}) {
    const auto ground = ground_lean(floor_seen_with(offset_px), kFocalBaseline_px_m);
    ASSERT_TRUE(ground) << offset_px;
    EXPECT_NEAR(ground->offset_px, offset_px, 0.06);
    // 1.2 m / 30 px m, of a gravity that is not quite square to the image's axis.
    EXPECT_NEAR(ground->lean_deg, offset_px * 0.04 * std::cos(0.2) * 180.0 / M_PI, 0.15);
  }
}

TEST(GroundLean, TellsATurnThatBendsTheGround) {
  for (const double offset_px : {-1.5, 1.5, 3.0}) {
    const auto ground =
        ground_lean(floor_seen_with(offset_px, Offset::kOfATurn), kFocalBaseline_px_m);
    ASSERT_TRUE(ground) << offset_px;
    EXPECT_NEAR(ground->offset_px, offset_px, 0.15);
  }
}

TEST(GroundLean, IsNotToldByTheGroundThatToldGravity) {
  Cloud cloud = floor_seen_with(1.5);
  for (const GravitySource source : {GravitySource::kGroundPlane, GravitySource::kLevel}) {
    cloud.stamp.gravity.source = source;
    EXPECT_FALSE(ground_lean(cloud, kFocalBaseline_px_m));
  }
}

TEST(GroundLean, IsNotToldWithoutGround) {
  Cloud cloud = floor_seen_with(1.5);
  cloud.points_m.assign(cloud.points_m.size(), Eigen::Vector3f::Zero());
  EXPECT_FALSE(ground_lean(cloud, kFocalBaseline_px_m));
}

TEST(GroundLean, IsNotToldByACameraThatLooksDown) {
  Cloud cloud = floor_seen_with(0.0);
  cloud.stamp.gravity.down = Eigen::Vector3f(0.0F, 0.3F, 1.0F).normalized();
  EXPECT_FALSE(ground_lean(cloud, kFocalBaseline_px_m));
}

}  // namespace
}  // namespace limbcast::reconstructor
