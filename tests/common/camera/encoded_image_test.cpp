#include "common/camera/encoded_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "common/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

using test::error_of;
using ::testing::HasSubstr;

cv::Mat ramp(int type) {
  cv::Mat image(48, 64, type);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) image.col(u).row(v).setTo(cv::Scalar::all(u + 2 * v));
  }
  return image;
}

TEST(EncodedImage, HeaderOfAJpegTellsItsSize) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const EncodedImage made = encode_jpeg(ramp(type), 90);
    const EncodedImage found = identify_image(made.bytes, "test");
    EXPECT_EQ(found.format, ImageFormat::kJpeg);
    EXPECT_EQ(found.width, 64);
    EXPECT_EQ(found.height, 48);
    EXPECT_EQ(found.channels, made.channels);
    EXPECT_EQ(found.bytes, made.bytes);
  }
}

TEST(EncodedImage, HeaderOfAPngTellsItsSize) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1}) {
    const EncodedImage made = encode_png(ramp(type));
    const EncodedImage found = identify_image(made.bytes, "test");
    EXPECT_EQ(found.format, ImageFormat::kPng);
    EXPECT_EQ(found.width, 64);
    EXPECT_EQ(found.height, 48);
    EXPECT_EQ(found.channels, made.channels);
    EXPECT_EQ(found.bits, made.bits);
  }
}

TEST(EncodedImage, PngKeepsEveryPixel) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1}) {
    const cv::Mat image = ramp(type);
    const cv::Mat decoded = decode_image(encode_png(image), "test");
    ASSERT_EQ(decoded.type(), image.type());
    EXPECT_EQ(cv::norm(decoded, image, cv::NORM_INF), 0.0);
  }
}

TEST(EncodedImage, GivesColoursAsGrey) {
  for (const EncodedImage& image : {encode_jpeg(ramp(CV_8UC3), 100), encode_png(ramp(CV_8UC3))}) {
    const cv::Mat grey = decode_grey(image, "test");
    ASSERT_EQ(grey.type(), CV_8UC1);
    EXPECT_LE(cv::norm(grey, ramp(CV_8UC1), cv::NORM_INF), 2.0);
  }
}

TEST(EncodedImage, KeepsPixelsWhereTheCameraStoodWhateverItsOrientationNoteSays) {
  EncodedImage image = encode_jpeg(ramp(CV_8UC3), 90);
  // EXIF: one entry, orientation (0x0112) = 6, turn by 90 degrees.
  const std::vector<std::uint8_t> exif = {0xFF, 0xE1, 0, 34, 'E', 'x', 'i', 'f', 0, 0,  'M', 'M',
                                          0,    42,   0, 0,  0,   8,   0,   1,   1, 18, 0,   3,
                                          0,    0,    0, 1,  0,   6,   0,   0,   0, 0,  0,   0};
  image.bytes.insert(image.bytes.begin() + 2, exif.begin(), exif.end());
  const cv::Mat pixels = decode_image(identify_image(image.bytes, "test"), "test");
  EXPECT_EQ(pixels.size(), cv::Size(64, 48));
}

TEST(EncodedImage, TornFilesAreRecognisedWhereverTheyEnd) {
  for (const EncodedImage& whole : {encode_jpeg(ramp(CV_8UC3), 90), encode_png(ramp(CV_8UC3))}) {
    for (std::size_t size = 0; size + 4 < whole.bytes.size(); size += 7) {
      const std::vector<std::uint8_t> torn(whole.bytes.begin(),
                                           whole.bytes.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_THROW(identify_image(torn, "test"), InputError) << size;
    }
  }
}

TEST(EncodedImage, TornPicturesWithAnEndAreNotTakenForWhole) {
  const EncodedImage whole = encode_jpeg(ramp(CV_8UC3), 90);
  constexpr std::size_t kEndMarker = 2;
  std::vector<std::uint8_t> torn(whole.bytes.begin(), whole.bytes.end() - 200);
  torn.insert(torn.end(), whole.bytes.end() - kEndMarker, whole.bytes.end());
  const EncodedImage image = identify_image(torn, "test");
  EXPECT_EQ(error_of<InputError>([&] { decode_image(image, "a_left.jpg"); }),
            "a_left.jpg: cannot be decoded; copy or record it again, or leave the frame out");
}

TEST(EncodedImage, WhatACameraLeavesBehindAPictureDoesNotMatter) {
  EncodedImage image = encode_jpeg(ramp(CV_8UC3), 90);
  const std::vector<std::uint8_t> rest(12, 0x55);
  image.bytes.insert(image.bytes.end() - 2, rest.begin(), rest.end());
  EXPECT_EQ(decode_image(identify_image(image.bytes, "test"), "test").size(), cv::Size(64, 48));
}

TEST(EncodedImage, OtherFilesAreNamed) {
  const test::TemporaryFolder folder;
  const std::string text = folder.write("a_left.jpg", "this is no picture");
  EXPECT_THAT(error_of<InputError>([&] { read_encoded_image(text); }),
              HasSubstr("a_left.jpg: is neither JPEG nor PNG"));
  const std::string empty = folder.write("b_left.jpg", "");
  EXPECT_THAT(error_of<InputError>([&] { read_encoded_image(empty); }), HasSubstr("is empty"));
  EXPECT_THAT(error_of<InputError>([&] { read_encoded_image(folder / "none.jpg"); }),
              HasSubstr("none.jpg: cannot be read"));
  EXPECT_EQ(error_of<InputError>([&] { read_encoded_image(folder.path()); }),
            folder.path() + ": is a folder; give a picture");
}

}  // namespace
}  // namespace limbcast
