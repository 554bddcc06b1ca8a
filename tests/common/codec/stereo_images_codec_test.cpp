#include "common/lcm_io/stereo_images_codec.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "common/lcm_io/message_error.hpp"
#include "tests/common/codec/codec_values.hpp"

namespace limbcast::lcm_io {
namespace {

TEST(StereoImagesCodec, RejectsPairsOfUnequalSize) {
  StereoImages images{test_stamp(), cv::Mat(8, 8, CV_8UC1, cv::Scalar(1)),
                      cv::Mat(8, 9, CV_8UC1, cv::Scalar(1))};
  EXPECT_THROW(from_message(to_message(images, ImageCoding::kRaw, 90)), MessageError);
  images.right = cv::Mat();
  EXPECT_THROW(from_message(to_message(images, ImageCoding::kRaw, 90)), MessageError);
}

}  // namespace
}  // namespace limbcast::lcm_io
