// Messages in which every field says something: all of it comes back.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "common/lcm_io/encode.hpp"
#include "tests/common/codec/codec_messages.hpp"

namespace limbcast::lcm_io {
namespace {

TEST(CodecMessages, KeepEveryFieldOfAStamp) {
  const stamp_t message = stamp_message();
  EXPECT_EQ(encode(to_message(from_message(message))), encode(message));
}

TEST(CodecMessages, KeepEveryFieldOfABodyPose) {
  const body_poses_t message = body_poses_message();
  EXPECT_EQ(encode(to_message(from_message(message))), encode(message));
}

TEST(CodecMessages, KeepEveryFieldOfACalibration) {
  const stereo_calibration_t message = calibration_message();
  EXPECT_EQ(encode(to_message(from_message(message), message.utime, message.sensor)),
            encode(message));
}

TEST(CodecMessages, TakeNoMemoryForElementsThatTheyOnlyClaim) {
  lens_t lens{};
  std::vector<std::uint8_t> bytes = encode(lens);
  // The number of coefficients is last: 2^24 of them claimed, none there.
  bytes[bytes.size() - 4] = 1;
  EXPECT_LT(lens.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
  EXPECT_EQ(lens.distortion.size(), 0U);
}

/// The message with another value in one of its bytes does not decode.
template <class Message>
void expect_undecodable(const Message& message, std::size_t byte, std::uint8_t value) {
  std::vector<std::uint8_t> bytes = encode(message);
  bytes[byte] = value;
  Message decoded{};
  EXPECT_LT(decoded.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
}

TEST(CodecMessages, DoNotDecodeWhereACountIsNegative) {
  const lens_t lens{};
  constexpr std::uint8_t kSign = 0x80;
  expect_undecodable(lens, encode(lens).size() - sizeof(lens.num_distortion), kSign);
}

TEST(CodecMessages, DoNotDecodeWhereATextsLengthIsNegativeOrZero) {
  stamp_t stamp{};
  constexpr std::size_t kHashUtimeAndSequence = 3 * sizeof(std::int64_t);
  // LCM takes one off for the end of the text: -2147483647 becomes the smallest number, and
  // -2147483648 the largest.
  for (const std::uint8_t sign : {0x80, 0xFF})
    expect_undecodable(stamp, kHashUtimeAndSequence, sign);
  // The length's last byte: 0 instead of 1.
  expect_undecodable(stamp, kHashUtimeAndSequence + 3, 0);
}

TEST(CodecMessages, TakeNoMoreThanSixteenTimesTheirSizeInMemory) {
  // As many joints' persons claimed as there are bytes: each would take hundreds of bytes.
  body_poses_t poses{};
  poses.num_persons = 1;
  poses.persons.resize(1);
  std::vector<std::uint8_t> bytes = encode(poses);
  const std::size_t one_person = body_pose_t{}.getEncodedSize() - sizeof(std::int64_t);
  const std::size_t count = bytes.size() - one_person - sizeof(poses.num_persons);
  bytes[count + 2] = 1;  // 257 persons, and enough bytes for that many bytes
  ASSERT_GT(one_person, 257U);
  body_poses_t decoded{};
  EXPECT_LT(decoded.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
  EXPECT_LE(decoded.persons.size() * sizeof(body_pose_t), 16 * bytes.size());
}

TEST(CodecMessages, KeepEveryFieldOfASegment) {
  const segments_t message = segments_message();
  const Segments segments = from_message(message);
  EXPECT_EQ(encode(to_message(segments)), encode(message));

  EXPECT_EQ(encode(to_message(segments.stamp)), encode(stamp_message()));
  ASSERT_EQ(segments.segments.size(), 1U);
  const Segment& segment = segments.segments[0];
  EXPECT_EQ(segment.id, 9);
  EXPECT_EQ(segment.seed_m, Eigen::Vector3f(0.1F, 0.2F, 2.0F));
  EXPECT_EQ(segment.seed_kind, SeedKind::kBody);
  EXPECT_EQ(segment.seed_score, 0.7F);
  EXPECT_EQ(segment.face.facing_log_odds, 2.5F);
  EXPECT_EQ(segment.face.looks_right_log_odds, -1.5F);
  ASSERT_EQ(segment.image_poses.size(), 3U);
  EXPECT_TRUE(segment.image_poses[1].joints.empty());
  EXPECT_EQ(segment.image_poses[2].person_score, 0.5F);
  EXPECT_EQ(segment.image_poses[0].person_score, 0.6F);
  ASSERT_EQ(segment.image_poses[0].joints.size(), 2U);
  const ImageJoint& joint = segment.image_poses[0].joints[1];
  EXPECT_EQ(joint.joint, Joint::kAnkleRight);
  EXPECT_EQ(joint.px, Eigen::Vector2f(30.0F, 700.0F));
  EXPECT_EQ(joint.visibility, 0.1F);
  EXPECT_EQ(joint.behind_hips_m, 0.3F);
  EXPECT_EQ(joint.spread_m, 0.02F);
  EXPECT_EQ(segment.rejected_by, SegmentFilter::kNotHeadShaped);
  EXPECT_EQ(segment.filter_figure, 12.0F);
  EXPECT_EQ(segment.filter_limit, 300.0F);
  // Sixteen bits over 60 m are steps of 1.8 mm.
  EXPECT_LT((segment.points_m[1] - Eigen::Vector3f(-33.0F, 1.0F, 60.0F)).norm(), 0.004F);
  EXPECT_EQ(segment.is_skin, (std::vector<std::uint8_t>{0, 1}));
  const RangeImage& image = *segment.range_image;
  EXPECT_EQ(image.camera.fy, 51.0);
  EXPECT_EQ(image.origin_u, 5);
  EXPECT_EQ(image.origin_v, 6);
  EXPECT_EQ(image.full_width, 40);
  EXPECT_EQ(image.full_height, 30);
  EXPECT_EQ(image.frame_from_image(0, 2), 1.0F);
  EXPECT_EQ(image.is_skin, std::vector<std::uint8_t>(12, 1));
}

TEST(CodecMessages, SayHowManyEntriesTheirListsHave) {
  EXPECT_EQ(segments_message().num_segments, 1);
  EXPECT_EQ(to_message(from_message(body_poses_message())).num_persons, 1);
}

TEST(CodecMessages, KeepBothImagesOfAPairInEveryCoding) {
  const StereoImages images{from_message(stamp_message()),
                            cv::Mat(12, 16, CV_8UC3, cv::Scalar(10, 120, 200)),
                            cv::Mat(12, 16, CV_8UC3, cv::Scalar(90, 40, 30))};
  struct Expected {
    ImageCoding coding;
    int encoding;
    double largest_difference;
  };
  for (const Expected expected : {Expected{ImageCoding::kRaw, image_t::RAW_BGR8, 0.0},
                                  Expected{ImageCoding::kPng, image_t::PNG, 0.0},
                                  Expected{ImageCoding::kJpeg, image_t::JPEG, 4.0}}) {
    const stereo_images_t message = to_message(images, expected.coding, 95);
    EXPECT_EQ(message.left.encoding, expected.encoding);
    EXPECT_EQ(message.right.encoding, expected.encoding);
    const StereoImages back = from_message(message);
    EXPECT_LE(cv::norm(back.left, images.left, cv::NORM_INF), expected.largest_difference);
    EXPECT_LE(cv::norm(back.right, images.right, cv::NORM_INF), expected.largest_difference);
    EXPECT_EQ(encode(to_message(back.stamp)), encode(stamp_message()));
  }
}

TEST(CodecMessages, KeepColorAndCalibrationOfDepthImages) {
  DepthCalibration calibration;
  calibration.color = from_message(lens_message(20.0));
  calibration.depth_scale_m = 0.002;
  calibration.mounting = from_message(mounting_message());
  const DepthImages images{from_message(stamp_message()),
                           cv::Mat(12, 16, CV_8UC3, cv::Scalar(10, 120, 200)),
                           noise_image(CV_16UC1)};
  const CalibratedDepthImages back = from_message(to_message(images, calibration, 95));
  EXPECT_LE(cv::norm(back.images.color, images.color, cv::NORM_INF), 4.0);
  EXPECT_EQ(encode(to_message(back.images.stamp)), encode(stamp_message()));
  EXPECT_EQ(encode(to_message(back.calibration.color)), encode(lens_message(20.0)));
  EXPECT_EQ(encode(to_message(back.calibration.mounting)), encode(mounting_message()));
  EXPECT_EQ(back.calibration.depth_scale_m, 0.002);
}

TEST(CodecMessages, KeepCameraAndColorsOfAnOrganizedCloud) {
  const Cloud back = from_message(to_message(small_cloud(), 95));
  EXPECT_EQ(encode(to_message(back.stamp)), encode(stamp_message()));
  EXPECT_EQ(back.camera->fx, 50.0);
  EXPECT_EQ(back.camera->fy, 51.0);
  EXPECT_EQ(back.camera->cx, 7.0);
  EXPECT_EQ(back.camera->cy, 8.0);
  ASSERT_EQ(back.colors.size(), 256U);
  EXPECT_NEAR(back.colors[255].b, 10, 4);
  EXPECT_NEAR(back.colors[255].g, 120, 4);
  EXPECT_NEAR(back.colors[255].r, 200, 4);
}

TEST(CodecMessages, TakeGreyPixelsAsColorsOfACloud) {
  point_cloud_t message = to_message(small_cloud());
  message.color = to_raw_message(cv::Mat(16, 16, CV_8UC1, cv::Scalar(77)));
  const Cloud back = from_message(message);
  ASSERT_EQ(back.colors.size(), 256U);
  EXPECT_EQ(back.colors[255].b, 77);
  EXPECT_EQ(back.colors[255].r, 77);
}

}  // namespace
}  // namespace limbcast::lcm_io
