#include "modules/reconstructor/stage.hpp"

#include <gtest/gtest.h>

#include <string>

#include "common/lcm_io/depth_images_codec.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"

namespace limbcast::reconstructor {
namespace {

constexpr int kWidth = 64, kHeight = 48;

/// A wall at 1 m before a lens that magnifies the image's edge by k1.
depth_images_t wall(const std::string& sensor, double k1) {
  DepthCalibration calibration;
  calibration.color = {{kWidth, kHeight, 50.0, 50.0, 31.5, 23.5}, {k1, 0.0, 0.0, 0.0}};
  DepthImages images;
  images.stamp.sensor = sensor;
  images.depth = cv::Mat1w(kHeight, kWidth, ushort{1000});
  return lcm_io::to_message(images, calibration, 90);
}

/// Pixels of the cloud that the image does not reach.
std::size_t holes(const point_cloud_t& message) {
  const Cloud cloud = lcm_io::from_message(message);
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) count += cloud.is_hole(i) ? 1 : 0;
  return count;
}

class DepthCameras : public ::testing::Test {
 protected:
  std::size_t holes_of(const std::string& sensor, double k1) const {
    return holes(stage_.process(wall(sensor, k1)));
  }
  const Stage stage_{StageOptions{}};
};

TEST_F(DepthCameras, AreEachUndistortedByTheirOwnLens) {
  for (int frame = 0; frame < 2; ++frame) {
    EXPECT_EQ(holes_of("even", 0.0), 0U);
    EXPECT_GT(holes_of("bent", 0.3), 0U);
  }
}

TEST_F(DepthCameras, AreUndistortedByTheCalibrationThatCameLast) {
  EXPECT_EQ(holes_of("camera", 0.0), 0U);
  const std::size_t bent = holes_of("camera", 0.15);
  EXPECT_GT(bent, 0U);
  EXPECT_GT(holes_of("camera", 0.3), bent);
  EXPECT_EQ(holes_of("camera", 0.0), 0U);
}

}  // namespace
}  // namespace limbcast::reconstructor
