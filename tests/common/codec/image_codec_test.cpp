#include "common/lcm_io/image_codec.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "common/lcm_io/message_error.hpp"

namespace limbcast::lcm_io {
namespace {

TEST(ImageCodec, RawAndPngAreLosslessJpegIsClose) {
  cv::Mat image(12, 16, CV_8UC3);
  cv::randu(image, 0, 255);
  EXPECT_EQ(cv::norm(from_message(to_raw_message(image)), image, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(from_message(to_png_message(image)), image, cv::NORM_INF), 0.0);
  const cv::Mat flat(16, 16, CV_8UC3, cv::Scalar(10, 120, 200));
  EXPECT_LE(cv::norm(from_message(to_jpeg_message(flat, 95)), flat, cv::NORM_INF), 4.0);
}

TEST(ImageCodec, RejectsForeignTruncatedAndMislabelledData) {
  const image_t good = to_raw_message(cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(1)));
  image_t bad = good;
  bad.data.resize(10);
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.encoding = image_t::JPEG;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = to_jpeg_message(cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(1)), 90);
  bad.width = 5;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.width = -4;
  EXPECT_THROW(from_message(bad), MessageError);
}

}  // namespace
}  // namespace limbcast::lcm_io
