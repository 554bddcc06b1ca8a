// Messages in which every field says something: all of it comes back, and what no sender may say is
// refused with the name of what is wrong.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/compression.hpp"
#include "common/lcm_io/depth_images_codec.hpp"
#include "common/lcm_io/image_codec.hpp"
#include "common/lcm_io/message_error.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/segments_codec.hpp"
#include "common/lcm_io/stamp_codec.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "tests/common/infinite_numbers.hpp"

namespace limbcast::lcm_io {
namespace {

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  std::vector<std::uint8_t> bytes(message.getEncodedSize());
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <class Message>
struct Refusal {
  std::function<void(Message&)> change;
  std::string told;
};

/// Makes each change to a good message by itself; reading it must end with a text that holds
/// `told`.
template <class Message>
void expect_refused(const Message& good, const std::vector<Refusal<Message>>& refusals) {
  EXPECT_NO_THROW(from_message(good));
  for (std::size_t i = 0; i < refusals.size(); ++i) {
    Message bad = good;
    refusals[i].change(bad);
    try {
      from_message(bad);
      ADD_FAILURE() << "change " << i << " was taken: " << refusals[i].told;
    } catch (const MessageError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(refusals[i].told)) << "change " << i;
    }
  }
}

stamp_t stamp_message() {
  stamp_t message{};
  message.utime = 1768870000000000;
  message.sequence = 42;
  message.sensor = "front";
  message.frame = "front/left_rectified";
  message.down[1] = 0.8F;
  message.down[2] = 0.6F;
  message.gravity_source = stamp_t::GRAVITY_LEVEL;
  message.sensor_height_m = 1.2F;
  message.noise_constant_m = 0.001F;
  message.noise_quadratic_per_m = 0.002F;
  return message;
}

body_poses_t body_poses_message() {
  body_poses_t message{};
  message.stamp = stamp_message();
  body_pose_t pose{};
  pose.id = 3;
  for (int i = 0; i < kJointCount; ++i) {
    joint_t& joint = pose.joints[i];
    const auto number = static_cast<float>(i + 1);
    joint.name = kJointNames[i];
    joint.valid = 1;
    joint.predicted = 1;
    std::iota(joint.position_m, joint.position_m + 3, number);
    joint.confidence = 0.01F * number;
    joint.sigma_m = 0.02F * number;
    pose.link_lengths_m[i] = 0.03F * number;
  }
  std::iota(pose.angles_rad, pose.angles_rad + kDegreesOfFreedom, 1.0F);
  std::iota(pose.error_terms, pose.error_terms + kErrorTermCount, 1.0F);
  pose.confidence = 0.9F;
  pose.error = 0.04F;
  pose.typical_pose = 12;
  pose.rotation_deg = 33.3F;
  pose.scale = 0.95F;
  pointing_t pointing{};
  pointing.side = pointing_t::RIGHT;
  const auto set = [](float(&direction)[3], float x, float y, float z) {
    direction[0] = x;
    direction[1] = y;
    direction[2] = z;
  };
  set(pointing.direction, 0.36F, 0.48F, -0.8F);
  set(pointing.forearm, -0.48F, 0.8F, 0.36F);
  set(pointing.head_hand, 0.8F, -0.36F, 0.48F);
  pointing.sigma_rad = 0.05F;
  pointing.confidence = 0.8F;
  pose.pointing = {pointing};
  pose.num_pointing = 1;
  message.persons = {pose};
  message.num_persons = 1;
  return message;
}

lens_t lens_message(double first) {
  lens_t message{};
  message.width = 16;
  message.height = 12;
  message.fx = first;
  message.fy = first + 1.0;
  message.cx = first + 2.0;
  message.cy = first + 3.0;
  message.distortion = {0.1, -0.2, 0.01, 0.02};
  message.num_distortion = 4;
  return message;
}

/// The rotation that takes x to y, y to z, z to x.
template <class Number>
void write_turn(Number* rows) {
  std::fill(rows, rows + 9, Number(0));
  rows[2] = rows[3] = rows[7] = Number(1);
}

mounting_t mounting_message() {
  mounting_t message{};
  message.has_down = 1;
  message.down[1] = 0.8;
  message.down[2] = 0.6;
  message.sensor_height_m = 1.3;
  return message;
}

stereo_calibration_t calibration_message() {
  stereo_calibration_t message{};
  message.utime = 7;
  message.sensor = "front";
  message.left = lens_message(20.0);
  message.right = lens_message(30.0);
  for (double* rows : {message.R, message.R1, message.R2}) write_turn(rows);
  std::iota(message.T, message.T + 3, 1.0);
  message.has_rectification = 1;
  std::iota(message.P1, message.P1 + 12, 1.0);
  std::iota(message.P2, message.P2 + 12, 13.0);
  message.mounting = mounting_message();
  return message;
}

cv::Mat noise_image(int type) {
  cv::Mat image(12, 16, type);
  cv::randu(image, 1, 250);
  return image;
}

/// A person in a turned window of a lattice, so that the points are told by themselves.
segments_t segments_message() {
  RangeImage image;
  image.camera = {4, 3, 50.0, 51.0, 2.0, 1.0};
  image.origin_u = 5;
  image.origin_v = 6;
  image.full_width = 40;
  image.full_height = 30;
  image.depth_m.assign(12, 2.0F);
  image.labels.assign(12, PixelLabel::kPerson);
  image.is_skin.assign(12, 1);
  image.frame_from_image << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  Segment segment;
  segment.id = 9;
  segment.seed_m = {0.1F, 0.2F, 2.0F};
  segment.seed_kind = SeedKind::kBody;
  segment.seed_score = 0.7F;
  segment.face = {2.5F, -1.5F};
  segment.rejected_by = SegmentFilter::kNotHeadShaped;
  segment.filter_figure = 12.0F;
  segment.filter_limit = 300.0F;
  segment.points_m = {{0.5F, -0.5F, 2.0F}, {-33.0F, 1.0F, 60.0F}};
  segment.is_skin = {0, 1};
  segment.range_image = image;
  return to_message({from_message(stamp_message()), {segment}});
}

TEST(CodecMessages, KeepEveryFieldOfAStamp) {
  const stamp_t message = stamp_message();
  EXPECT_EQ(bytes_of(to_message(from_message(message))), bytes_of(message));
}

TEST(CodecMessages, KeepEveryFieldOfABodyPose) {
  const body_poses_t message = body_poses_message();
  EXPECT_EQ(bytes_of(to_message(from_message(message))), bytes_of(message));
}

TEST(CodecMessages, KeepEveryFieldOfACalibration) {
  const stereo_calibration_t message = calibration_message();
  EXPECT_EQ(bytes_of(to_message(from_message(message), message.utime, message.sensor)),
            bytes_of(message));
}

TEST(CodecMessages, TakeNoMemoryForElementsThatTheyOnlyClaim) {
  lens_t lens{};
  std::vector<std::uint8_t> bytes = bytes_of(lens);
  // The number of coefficients is last: 2^24 of them claimed, none there.
  bytes[bytes.size() - 4] = 1;
  EXPECT_LT(lens.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
  EXPECT_EQ(lens.distortion.size(), 0U);
}

/// The message with another value in one of its bytes does not decode.
template <class Message>
void expect_undecodable(const Message& message, std::size_t byte, std::uint8_t value) {
  std::vector<std::uint8_t> bytes = bytes_of(message);
  bytes[byte] = value;
  Message decoded{};
  EXPECT_LT(decoded.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
}

TEST(CodecMessages, DoNotDecodeWhereACountIsNegative) {
  const lens_t lens{};
  constexpr std::uint8_t kSign = 0x80;
  expect_undecodable(lens, bytes_of(lens).size() - sizeof(lens.num_distortion), kSign);
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
  std::vector<std::uint8_t> bytes = bytes_of(poses);
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
  EXPECT_EQ(bytes_of(to_message(segments)), bytes_of(message));

  EXPECT_EQ(bytes_of(to_message(segments.stamp)), bytes_of(stamp_message()));
  ASSERT_EQ(segments.segments.size(), 1U);
  const Segment& segment = segments.segments[0];
  EXPECT_EQ(segment.id, 9);
  EXPECT_EQ(segment.seed_m, Eigen::Vector3f(0.1F, 0.2F, 2.0F));
  EXPECT_EQ(segment.seed_kind, SeedKind::kBody);
  EXPECT_EQ(segment.seed_score, 0.7F);
  EXPECT_EQ(segment.face.facing_log_odds, 2.5F);
  EXPECT_EQ(segment.face.looks_right_log_odds, -1.5F);
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
    EXPECT_EQ(bytes_of(to_message(back.stamp)), bytes_of(stamp_message()));
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
  EXPECT_EQ(bytes_of(to_message(back.images.stamp)), bytes_of(stamp_message()));
  EXPECT_EQ(bytes_of(to_message(back.calibration.color)), bytes_of(lens_message(20.0)));
  EXPECT_EQ(bytes_of(to_message(back.calibration.mounting)), bytes_of(mounting_message()));
  EXPECT_EQ(back.calibration.depth_scale_m, 0.002);
}

Cloud small_cloud() {
  Cloud cloud;
  cloud.stamp = from_message(stamp_message());
  cloud.width = 16;
  cloud.height = 16;
  cloud.camera = PinholeCamera{16, 16, 50.0, 51.0, 7.0, 8.0};
  cloud.points_m.assign(256, {0.0F, 0.0F, 2.0F});
  cloud.colors.assign(256, {10, 120, 200});
  return cloud;
}

TEST(CodecMessages, KeepCameraAndColorsOfAnOrganizedCloud) {
  const Cloud back = from_message(to_message(small_cloud(), 95));
  EXPECT_EQ(bytes_of(to_message(back.stamp)), bytes_of(stamp_message()));
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

TEST(CodecRefusals, NameWhatIsWrongWithAStamp) {
  expect_refused<stamp_t>(stamp_message(),
                          {{[](auto& m) { m.sensor = ""; }, "'sensor'"},
                           {[](auto& m) { m.down[0] = 2.0F; }, "'down'"},
                           {[](auto& m) { m.gravity_source = -1; }, "'gravity_source'"},
                           {[](auto& m) { m.sensor_height_m = -kInfinity; }, "'sensor_height_m'"},
                           {[](auto& m) { m.noise_constant_m = -0.1F; }, "noise"},
                           {[](auto& m) { m.noise_constant_m = kNaN; }, "noise"},
                           {[](auto& m) { m.noise_quadratic_per_m = kInfinity; }, "noise"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithABodyPose) {
  using Poses = body_poses_t;
  const auto pointing = [](Poses& m) -> pointing_t& { return m.persons[0].pointing[0]; };
  expect_refused<Poses>(
      body_poses_message(),
      {{[](Poses& m) { m.persons[0].joints[2].confidence = kNaN; }, "confidence or sigma"},
       {[](Poses& m) { m.persons[0].joints[2].sigma_m = kInfinity; }, "confidence or sigma"},
       {[](Poses& m) { m.persons[0].joints[2].position_m[1] = kNaN; }, "coordinate"},
       {[](Poses& m) { std::swap(m.persons[0].joints[2], m.persons[0].joints[3]); }, "name"},
       {[=](Poses& m) { pointing(m).side = 9; }, "unknown side"},
       {[](Poses& m) { m.persons[0].joints[2].position_m[1] = 3e38F; }, "coordinate"},
       {[=](Poses& m) { pointing(m).forearm[0] = kNaN; }, "coordinate"},
       {[=](Poses& m) { pointing(m).direction[0] = 2.0F; }, "no unit vector"},
       {[=](Poses& m) { pointing(m).sigma_rad = kNaN; }, "uncertainty of a direction"},
       {[=](Poses& m) { pointing(m).confidence = kNaN; }, "uncertainty of a direction"},
       {[](Poses& m) { m.persons[0].confidence = kNaN; }, "error is not finite"},
       {[](Poses& m) { m.persons[0].error = kInfinity; }, "error is not finite"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithASegment) {
  using Message = segments_t;
  const auto window = [](Message& m) -> range_image_t& { return m.segments[0].windows[0]; };
  const std::string size = "size of a window", camera = "camera of a window",
                    scale = "'inverse_depth_scale'";
  expect_refused<Message>(
      segments_message(),
      {{[=](Message& m) { window(m).width = 0; }, size},
       {[=](Message& m) { window(m).height = -3; }, size},
       {[=](Message& m) { window(m).width = 9000; }, size},
       {[=](Message& m) { window(m).height = 9000; }, size},
       {[=](Message& m) { window(m).fx = 0.0; }, camera},
       {[=](Message& m) { window(m).fy = -1.0; }, camera},
       {[=](Message& m) { window(m).cx = kNaN; }, camera},
       {[=](Message& m) { window(m).cy = kInfinity; }, camera},
       {[=](Message& m) { window(m).fx = 1e30; }, camera},
       {[=](Message& m) { window(m).origin_u = 2'000'000'000; }, "place of a window"},
       {[=](Message& m) { window(m).full_height = -1; }, "place of a window"},
       {[=](Message& m) { window(m).inverse_depth_scale = 0.0; }, scale},
       {[=](Message& m) { window(m).inverse_depth_scale = 1e12; }, "farther than any sensor sees"},
       {[=](Message& m) { window(m).inverse_depth_scale = kInfinity; }, scale},
       {[=](Message& m) { window(m).frame_from_image[8] = 0.1F; }, "rotation of a window"},
       {[](Message& m) { m.segments[0].seed_m[1] = kNaN; }, "seed is not finite"},
       {[](Message& m) { m.segments[0].facing_log_odds = kNaN; }, "odds of a face"},
       {[](Message& m) { m.segments[0].looks_right_log_odds = kInfinity; }, "odds of a face"},
       {[](Message& m) { m.segments[0].seed_kind = -1; }, "'seed_kind'"},
       {[](Message& m) { m.segments[0].seed_kind = 4; }, "'seed_kind'"},
       {[](Message& m) { m.segments[0].rejected_by = -1; }, "'rejected_by'"},
       {[](Message& m) { m.segments[0].rejected_by = 7; }, "'rejected_by'"},
       {[](Message& m) { m.segments[0].num_points = -1; }, "number of points"},
       {[](Message& m) { m.segments[0].num_points = 8'000'001; }, "number of points"},
       {[](Message& m) { m.segments[0].resolution_m = 0.0; }, "'resolution_m'"},
       {[](Message& m) { m.segments[0].skin.pop_back(); }, "skin flags"},
       {[=](Message& m) { m.segments[0].windows.push_back(window(m)); }, "more than one window"},
       {[](Message& m) {
          m.segments[0].windows.clear();
          m.segments[0].has_points = 0;
        },
        "neither points nor window"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithACalibration) {
  using Message = stereo_calibration_t;
  const std::string size = "image size", focal = "focal length or principal point",
                    rotation = "a rotation is none";
  expect_refused<Message>(
      calibration_message(),
      {{[](Message& m) { m.left.width = 0; }, size},
       {[](Message& m) { m.right.height = -1; }, size},
       {[](Message& m) { m.left.width = 100'000; }, size},
       {[](Message& m) { m.left.fx = 0.0; }, focal},
       {[](Message& m) { m.left.fy = 0.0; }, focal},
       {[](Message& m) { m.right.fy = kNaN; }, focal},
       {[](Message& m) { m.left.cx = kNaN; }, focal},
       {[](Message& m) { m.left.cy = kInfinity; }, focal},
       {[](Message& m) { m.left.cy = 1e9; }, focal},
       {[](Message& m) { m.left.fx = 1e-3; }, focal},
       {[](Message& m) { m.left.fy = 1e9; }, focal},
       {[](Message& m) { m.left.num_distortion = 3; }, "number of distortion coefficients"},
       {[](Message& m) { m.left.distortion[1] = kNaN; }, "distortion coefficient is not finite"},
       {[](Message& m) { m.R[0] = 2.0; }, rotation},
       // Mirrored: orthogonal, but no rotation.
       {[](Message& m) { m.R2[2] = -1.0; }, rotation},
       {[](Message& m) { m.T[1] = kNaN; }, "a number is not finite"},
       {[](Message& m) { m.P2[11] = kInfinity; }, "a number is not finite"},
       {[](Message& m) { m.mounting.down[0] = 1.0; }, "'down'"},
       {[](Message& m) { m.mounting.sensor_height_m = kInfinity; }, "'sensor_height_m'"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithDepthImages) {
  DepthCalibration calibration;
  calibration.color = from_message(lens_message(20.0));
  const depth_images_t good =
      to_message({from_message(stamp_message()), noise_image(CV_8UC3), noise_image(CV_16UC1)},
                 calibration, 90);
  expect_refused<depth_images_t>(
      good,
      {{[](auto& m) { m.depth_scale_m = 0.0; }, "'depth_scale_m'"},
       {[](auto& m) { m.depth_scale_m = kInfinity; }, "'depth_scale_m'"},
       {[](auto& m) { m.depth = to_png_message(noise_image(CV_8UC1)); }, "not 16 bit"},
       {[](auto& m) { m.lens.width = 17; }, "differs from the calibration"},
       {[](auto& m) { m.lens.height = 13; }, "differs from the calibration"},
       {[](auto& m) { m.color = to_png_message(noise_image(CV_16UC1)); }, "colour"},
       {[](auto& m) { m.color = to_png_message(noise_image(CV_8UC3).rowRange(0, 8)); }, "colour"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithStereoImages) {
  const stereo_images_t good =
      to_message({from_message(stamp_message()), noise_image(CV_8UC3), noise_image(CV_8UC3)},
                 ImageCoding::kPng, 90);
  expect_refused<stereo_images_t>(
      good, {{[](auto& m) { m.left = image_t{}; }, "an image is missing"},
             {[](auto& m) { m.right = image_t{}; }, "an image is missing"},
             {[](auto& m) { m.right = to_png_message(noise_image(CV_8UC3).colRange(0, 8)); },
              "differ in size"},
             {[](auto& m) { m.right = to_png_message(noise_image(CV_16UC1)); }, "not 8 bit"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithAnImage) {
  const std::string range = "size is out of range", decoded = "decoded size differs";
  expect_refused<image_t>(to_png_message(noise_image(CV_8UC3)),
                          {{[](auto& m) { m.width = 9000; }, range},
                           {[](auto& m) { m.height = 9000; }, range},
                           {[](auto& m) { m.width = 0; }, range},
                           {[](auto& m) { m.data.clear(); }, "no data"},
                           {[](auto& m) { m.width = 17; }, decoded},
                           {[](auto& m) { m.height = 13; }, decoded},
                           {[](auto& m) { m.data.resize(20); }, "cannot be decoded"},
                           {[](auto& m) { m.encoding = 99; }, "unknown encoding"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithACloud) {
  const std::string camera = "camera is not sound", size = "size is out of range";
  expect_refused<point_cloud_t>(
      to_message(small_cloud()),
      {{[](auto& m) { m.width = -16; }, size},
       {[](auto& m) { m.width = m.height = 1'000'000; }, size},
       {[](auto& m) { m.layout = 9; }, "unknown layout"},
       {[](auto& m) { m.fx = 0.0; }, camera},
       {[](auto& m) { m.fy = -1.0; }, camera},
       {[](auto& m) { m.cy = kNaN; }, camera},
       {[](auto& m) { m.fx = 1e30; }, camera},
       {[](auto& m) { m.inverse_depth_scale = 0.0; }, "'inverse_depth_scale'"},
       {[](auto& m) { m.inverse_depth_scale = 1e12; }, "farther than any sensor sees"},
       {[](auto& m) { m.color = to_png_message(noise_image(CV_8UC3)); }, "colour image"},
       {[](auto& m) { m.color = to_png_message(cv::Mat(16, 16, CV_16UC1, cv::Scalar(1))); },
        "colour image"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithAListOfPoints) {
  Cloud cloud = small_cloud();
  cloud.camera.reset();
  cloud.width = 256;
  cloud.height = 1;
  cloud.intensities.assign(256, 0.5F);
  cloud.rings.assign(256, 3);
  const std::string size = "another size", damaged = "damaged";
  expect_refused<point_cloud_t>(
      to_message(cloud), {{[](auto& m) { m.height = 2; }, "height 1"},
                          {[](auto& m) { m.resolution_m = 0.0; }, "'resolution_m'"},
                          {[](auto& m) { m.color.data.pop_back(); }, "colours of a list"},
                          {[](auto& m) { m.color.encoding = image_t::PNG; }, "colours of a list"},
                          {[](auto& m) { m.intensity_step = 0.0; }, "'intensity_step'"},
                          {[](auto& m) { m.intensity_step = kInfinity; }, "'intensity_step'"},
                          {[](auto& m) {
                             m.intensities = compress({1, 2, 3});
                           },
                           size},
                          {[](auto& m) { m.intensities.pop_back(); }, damaged},
                          {[](auto& m) {
                             m.rings = compress({1, 2, 3});
                           },
                           size},
                          {[](auto& m) { m.rings.pop_back(); }, damaged}});
}

}  // namespace
}  // namespace limbcast::lcm_io
