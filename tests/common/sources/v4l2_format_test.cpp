#include "common/sources/v4l2_format.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/sources/test_pictures.hpp"

namespace limbcast::test {
namespace {

using ::testing::Each;
using ::testing::Optional;

constexpr double kWanted_hz = 30.0;

std::optional<std::string> chosen(const std::vector<OfferedFormat>& offered, bool depth = false) {
  const auto fourcc = choose_format(offered, kWanted_hz, depth);
  if (!fourcc) return std::nullopt;
  return name_of(*fourcc);
}

TEST(ChooseFormat, TakesOneWithoutLossWhereItIsAsFast) {
  EXPECT_THAT(chosen({{V4L2_PIX_FMT_MJPEG, true, 60.0}, {V4L2_PIX_FMT_YUYV, true, 30.0}}),
              Optional(std::string("YUYV")));
}

TEST(ChooseFormat, TakesJpegWhereTheOthersAreTooSlow) {
  EXPECT_THAT(chosen({{V4L2_PIX_FMT_YUYV, true, 10.0}, {V4L2_PIX_FMT_MJPEG, true, 30.0}}),
              Optional(std::string("MJPG")));
}

TEST(ChooseFormat, TakesTheWantedSizeBeforeTheWantedRate) {
  EXPECT_THAT(chosen({{V4L2_PIX_FMT_YUYV, false, 30.0}, {V4L2_PIX_FMT_MJPEG, true, 15.0}}),
              Optional(std::string("MJPG")));
}

TEST(ChooseFormat, TakesARateThatTheDriverDoesNotTellForFastEnough) {
  EXPECT_THAT(chosen({{V4L2_PIX_FMT_YUYV, true, 0.0}, {V4L2_PIX_FMT_MJPEG, true, 30.0}}),
              Optional(std::string("YUYV")));
}

TEST(ChooseFormat, TakesColourBeforeGrey) {
  EXPECT_THAT(chosen({{V4L2_PIX_FMT_GREY, true, 30.0}, {V4L2_PIX_FMT_MJPEG, true, 30.0}}),
              Optional(std::string("MJPG")));
}

TEST(ChooseFormat, TakesDepthForDepthAndNothingElse) {
  const std::vector<OfferedFormat> both = {{V4L2_PIX_FMT_YUYV, true, 30.0},
                                           {V4L2_PIX_FMT_Z16, true, 30.0}};
  EXPECT_THAT(chosen(both, true), Optional(std::string("Z16")));
  EXPECT_THAT(chosen(both, false), Optional(std::string("YUYV")));
  EXPECT_EQ(chosen({{V4L2_PIX_FMT_SBGGR8, true, 30.0}}), std::nullopt);
}

TEST(FourCc, IsV4l2sNumberOfTheName) {
  for (const std::uint32_t fourcc : {V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_Z16}) {
    EXPECT_EQ(fourcc_of(name_of(fourcc)), fourcc);
  }
  EXPECT_EQ(name_of(V4L2_PIX_FMT_Z16), "Z16");
}

v4l2_pix_format format_of(std::uint32_t fourcc, std::uint32_t bytes_per_line = 0) {
  v4l2_pix_format format{};
  format.width = 4;
  format.height = 2;
  format.pixelformat = fourcc;
  format.bytesperline = bytes_per_line;
  return format;
}

std::optional<Picture> picture_of(const std::vector<std::uint8_t>& bytes,
                                  const v4l2_pix_format& format) {
  return picture_from(bytes.data(), bytes.size(), format);
}

/// Every pixel of 4 x 2 of them, blue, green and red.
std::vector<cv::Vec3b> colours_of(const std::vector<std::uint8_t>& bytes, std::uint32_t fourcc) {
  const std::optional<Picture> picture = picture_of(bytes, format_of(fourcc));
  if (!picture) return {};
  const cv::Mat pixels = plain_pixels(*picture, "test");
  if (pixels.size() != cv::Size(4, 2) || pixels.type() != CV_8UC3) return {};
  return {pixels.begin<cv::Vec3b>(), pixels.end<cv::Vec3b>()};
}

std::vector<std::uint8_t> repeated(const std::vector<std::uint8_t>& group, int times) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < times; ++i) bytes.insert(bytes.end(), group.begin(), group.end());
  return bytes;
}

MATCHER(IsRed, "") {
  // BT.601's red is Y 81, U 90, V 240, rounded to whole numbers.
  return arg[0] <= 2 && arg[1] <= 2 && arg[2] >= 253;
}

TEST(PictureFrom, HasTheColoursOfEachLayout) {
  std::vector<std::uint8_t> planes = repeated({81}, 8);
  const std::vector<std::uint8_t> packed = repeated({90, 240}, 2);
  planes.insert(planes.end(), packed.begin(), packed.end());
  EXPECT_THAT(colours_of(planes, V4L2_PIX_FMT_NV12), Each(IsRed()));
  std::copy_n(std::vector<std::uint8_t>{90, 90, 240, 240}.begin(), 4, planes.end() - 4);
  EXPECT_THAT(colours_of(planes, V4L2_PIX_FMT_YUV420), Each(IsRed()));
  EXPECT_THAT(colours_of(repeated({81, 90, 81, 240}, 4), V4L2_PIX_FMT_YUYV), Each(IsRed()));
  EXPECT_THAT(colours_of(repeated({90, 81, 240, 81}, 4), V4L2_PIX_FMT_UYVY), Each(IsRed()));
  EXPECT_THAT(colours_of(repeated({255, 0, 0}, 8), V4L2_PIX_FMT_RGB24), Each(IsRed()));
  EXPECT_THAT(colours_of(repeated({0, 0, 255}, 8), V4L2_PIX_FMT_BGR24), Each(IsRed()));
  EXPECT_EQ(colours_of(repeated({81, 90, 81, 240}, 4), V4L2_PIX_FMT_YUYV).size(), 8U);
}

TEST(PictureFrom, KeepsAllBitsOfDepthAndLeavesTheEndsOfLinesOut) {
  // Two lines of four values and four bytes that belong to none.
  const std::vector<std::uint8_t> bytes = {0x01, 0x10, 0x02, 0x20, 0x03, 0x30, 0x04, 0x40,
                                           9,    9,    9,    9,    0x05, 0x50, 0x06, 0x60,
                                           0x07, 0x70, 0x08, 0x80, 9,    9,    9,    9};
  const auto picture = picture_of(bytes, format_of(V4L2_PIX_FMT_Z16, 12));
  ASSERT_TRUE(picture);
  const cv::Mat depth = plain_pixels(*picture, "test");
  ASSERT_EQ(depth.type(), CV_16UC1);
  EXPECT_EQ(depth.at<std::uint16_t>(0, 3), 0x4004);
  EXPECT_EQ(depth.at<std::uint16_t>(1, 0), 0x5005);
}

TEST(PictureFrom, IsNothingOfABufferThatIsTooShort) {
  EXPECT_FALSE(picture_of(repeated({81, 90, 81, 240}, 3), format_of(V4L2_PIX_FMT_YUYV)));
}

class MotionJpeg : public ::testing::Test {
 protected:
  MotionJpeg() {
    format_ = format_of(V4L2_PIX_FMT_MJPEG);
    format_.width = 64;
    format_.height = 48;
  }
  v4l2_pix_format format_{};
  std::vector<std::uint8_t> bytes_ = encode_jpeg(grey_picture(64, 48, 90), 95).bytes;
};

TEST_F(MotionJpeg, IsHandedOnByteByByte) {
  const auto picture = picture_of(bytes_, format_);
  ASSERT_TRUE(picture);
  EXPECT_EQ(coded_for_sending(*picture, 50).bytes, bytes_);
  EXPECT_NEAR(plain_pixels(*picture, "test").at<cv::Vec3b>(10, 10)[0], 90, 1);
}

TEST_F(MotionJpeg, IsLeftOutWhereItIsTornOrOfAnotherSize) {
  const std::vector<std::uint8_t> torn(bytes_.begin(), bytes_.end() - 20);
  EXPECT_FALSE(picture_of(torn, format_));
  EXPECT_FALSE(picture_of({}, format_));
  format_.width = 32;
  EXPECT_FALSE(picture_of(bytes_, format_));
}

/// Many USB cameras leave the Huffman tables out, as they are always the same.
TEST_F(MotionJpeg, IsDecodedWithoutHuffmanTablesToo) {
  std::vector<std::uint8_t> bare;
  for (std::size_t at = 0; at < bytes_.size();) {
    if (at > 1 && bytes_[at] == 0xFF && bytes_[at + 1] == 0xC4) {
      at += 2U + static_cast<std::size_t>(bytes_[at + 2] << 8 | bytes_[at + 3]);
      continue;
    }
    bare.push_back(bytes_[at++]);
  }
  ASSERT_LT(bare.size(), bytes_.size());
  const auto picture = picture_of(bare, format_);
  ASSERT_TRUE(picture);
  EXPECT_NEAR(plain_pixels(*picture, "test").at<cv::Vec3b>(10, 10)[0], 90, 1);
}

}  // namespace
}  // namespace limbcast::test
