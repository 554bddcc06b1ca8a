#include "common/lcm_io/depth_images_codec.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/common/codec/codec_values.hpp"

namespace limbcast::lcm_io {
namespace {

TEST(DepthImagesCodec, KeepsDepthBitForBit) {
  DepthCalibration calibration;
  calibration.color.camera = {16, 12, 20.0, 20.0, 8.0, 6.0};
  cv::Mat depth(12, 16, CV_16UC1);
  cv::randu(depth, 0, 65535);
  const auto back =
      from_message(to_message(DepthImages{test_stamp(), cv::Mat(), depth}, calibration, 90));
  EXPECT_EQ(cv::norm(back.images.depth, depth, cv::NORM_INF), 0.0);
  EXPECT_TRUE(back.images.color.empty());
}

}  // namespace
}  // namespace limbcast::lcm_io
