#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <random>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/decode.hpp"
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

Stamp test_stamp() {
  Stamp stamp;
  stamp.utime = 1768870000000000;
  stamp.sequence = 42;
  stamp.sensor = "front";
  stamp.frame = "front/left_rectified";
  stamp.gravity.down = Eigen::Vector3f(0.0F, 0.8F, 0.6F);
  stamp.gravity.source = GravitySource::kRecording;
  stamp.gravity.sensor_height_m = 1.2F;
  // 0.15 px of a camera with 520.6 px focal length and 0.12 m baseline.
  stamp.depth_noise = {0.0F, 0.15F / (520.6F * 0.12F)};
  return stamp;
}

Cloud camera_cloud() {
  Cloud cloud;
  cloud.stamp = test_stamp();
  cloud.width = 40;
  cloud.height = 30;
  cloud.camera = PinholeCamera{40, 30, 50.0, 50.0, 19.5, 14.5};
  std::mt19937 random(3);
  std::uniform_real_distribution<float> depth(0.5F, 9.0F);
  for (int v = 0; v < cloud.height; ++v)
    for (int u = 0; u < cloud.width; ++u)
      cloud.points_m.push_back(cloud.camera->back_project(
          static_cast<float>(u), static_cast<float>(v), u == v ? 0.0F : depth(random)));
  cloud.colors.assign(cloud.points_m.size(), Bgr{30, 60, 200});
  return cloud;
}

TEST(StampCodec, CarriesEveryField) {
  const Stamp stamp = test_stamp();
  const Stamp back = from_message(to_message(stamp));
  EXPECT_EQ(back.utime, stamp.utime);
  EXPECT_EQ(back.sequence, stamp.sequence);
  EXPECT_EQ(back.sensor, stamp.sensor);
  EXPECT_EQ(back.frame, stamp.frame);
  EXPECT_EQ(back.gravity.down, stamp.gravity.down);
  EXPECT_EQ(back.gravity.source, stamp.gravity.source);
  EXPECT_EQ(back.gravity.sensor_height_m, stamp.gravity.sensor_height_m);
  EXPECT_EQ(back.depth_noise.quadratic_per_m, stamp.depth_noise.quadratic_per_m);
}

TEST(StampCodec, CarriesAnUnknownHeight) {
  Stamp stamp = test_stamp();
  stamp.gravity.sensor_height_m.reset();
  EXPECT_FALSE(from_message(to_message(stamp)).gravity.sensor_height_m.has_value());
}

TEST(StampCodec, RejectsWhatIsNotFinite) {
  const stamp_t good = to_message(test_stamp());
  stamp_t bad = good;
  bad.down[1] = kNaN;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.sensor_height_m = kInfinity;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.noise_quadratic_per_m = -1.0F;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.gravity_source = 77;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.sensor.clear();
  EXPECT_THROW(from_message(bad), MessageError);
}

TEST(PointCloudCodec, RoundsDepthsTenTimesFinerThanTheNoise) {
  const Cloud cloud = camera_cloud();
  const Cloud back = from_message(to_message(cloud));
  ASSERT_EQ(back.points_m.size(), cloud.points_m.size());
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    ASSERT_EQ(back.is_hole(i), cloud.is_hole(i));
    if (cloud.is_hole(i)) continue;
    const float z_m = cloud.points_m[i].z();
    // Steps of sigma / 10, so at most half of one off.
    EXPECT_LE(std::abs(back.points_m[i].z() - z_m),
              0.051F * cloud.stamp.depth_noise.sigma_m(z_m) + 1e-6F);
  }
}

TEST(PointCloudCodec, ChangesNothingTheSecondTime) {
  const Cloud once = from_message(to_message(camera_cloud()));
  const Cloud twice = from_message(to_message(once));
  EXPECT_EQ(once.points_m, twice.points_m);
}

TEST(PointCloudCodec, CarriesListsWithColors) {
  Cloud cloud;
  cloud.stamp = test_stamp();
  cloud.points_m = {{1.0F, -2.0F, 3.0F}, {-20.5F, 0.0F, -7.125F}};
  cloud.colors = {{1, 2, 3}, {4, 5, 6}};
  cloud.width = 2;
  cloud.height = 1;
  const Cloud back = from_message(to_message(cloud));
  ASSERT_EQ(back.points_m.size(), 2U);
  EXPECT_FALSE(back.organized());
  EXPECT_LT((back.points_m[1] - cloud.points_m[1]).norm(), 0.001F);  // one millimetre steps
  EXPECT_EQ(back.colors[1].g, 5);
}

/// A list of four points with intensities and rings.
Cloud laser_cloud(const std::vector<float>& intensities) {
  Cloud cloud;
  cloud.stamp = test_stamp();
  cloud.points_m.assign(4, {1.0F, -2.0F, 3.0F});
  cloud.intensities = intensities;
  cloud.rings = {0, 127, 40'000, 65'535};
  cloud.width = 4;
  cloud.height = 1;
  return cloud;
}

TEST(PointCloudCodec, CarriesWholeIntensitiesAndRingsAsTheyAre) {
  const Cloud cloud = laser_cloud({0.0F, 255.0F, -7.0F, 32'767.0F});
  const Cloud back = from_message(to_message(cloud));
  EXPECT_EQ(back.intensities, cloud.intensities);
  EXPECT_EQ(back.rings, cloud.rings);
}

TEST(PointCloudCodec, RoundsOtherIntensitiesToAShareOfTheLargest) {
  for (const float largest : {1.0F, 70'000.0F}) {
    const Cloud cloud = laser_cloud({0.0F, 0.37F * largest, 0.01F * largest, largest});
    const Cloud back = from_message(to_message(cloud));
    ASSERT_EQ(back.intensities.size(), 4U);
    // Half a step of 32767 that the largest is divided in.
    const float tolerance = 0.51F / 32'767.0F * largest;
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(back.intensities[i], cloud.intensities[i], tolerance);
  }
}

TEST(PointCloudCodec, SendsNothingOfIntensitiesAndRingsThatASensorDoesNotHave) {
  const point_cloud_t message = to_message(camera_cloud());
  EXPECT_EQ(message.intensities_size, 0);
  EXPECT_EQ(message.rings_size, 0);
  const Cloud back = from_message(message);
  EXPECT_TRUE(back.intensities.empty());
  EXPECT_TRUE(back.rings.empty());
}

TEST(PointCloudCodec, CarriesEmptyAndOnePointClouds) {
  Cloud cloud;
  cloud.stamp = test_stamp();
  cloud.height = 1;
  EXPECT_TRUE(from_message(to_message(cloud)).points_m.empty());
  cloud.points_m = {{0.0F, 0.0F, 1.0F}};
  cloud.width = 1;
  EXPECT_EQ(from_message(to_message(cloud)).points_m.size(), 1U);
}

TEST(PointCloudCodec, RejectsSizesThatDoNotFit) {
  const point_cloud_t good = to_message(camera_cloud());
  point_cloud_t bad = good;
  bad.width = 41;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.width = -5;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.width = bad.height = 1'000'000;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.fx = std::nan("");
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.layout = 9;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.color.width = 20;
  EXPECT_THROW(from_message(bad), MessageError);
}

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

TEST(StereoImagesCodec, RejectsPairsOfUnequalSize) {
  StereoImages images{test_stamp(), cv::Mat(8, 8, CV_8UC1, cv::Scalar(1)),
                      cv::Mat(8, 9, CV_8UC1, cv::Scalar(1))};
  EXPECT_THROW(from_message(to_message(images, ImageCoding::kRaw, 90)), MessageError);
  images.right = cv::Mat();
  EXPECT_THROW(from_message(to_message(images, ImageCoding::kRaw, 90)), MessageError);
}

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

TEST(CalibrationCodec, CarriesRectificationAndRejectsWhatIsNoRotation) {
  StereoCalibration calibration;
  calibration.left.camera = calibration.right.camera = {640, 480, 520.0, 521.0, 320.0, 240.0};
  calibration.left.distortion = {0.1, -0.2, 0.001, 0.002, 0.05};
  calibration.T = {-0.12, 0.0, 0.0};
  calibration.rectification = Rectification{};
  calibration.rectification->R1 = calibration.rectification->R2 = Eigen::Matrix3d::Identity();
  calibration.rectification->P1.setZero();
  calibration.rectification->P2.setConstant(2.0);
  calibration.mounting.down = Eigen::Vector3d(0.0, 1.0, 0.0);
  const stereo_calibration_t message = to_message(calibration, 7, "front");
  const StereoCalibration back = from_message(message);
  EXPECT_EQ(back.left.distortion, calibration.left.distortion);
  EXPECT_EQ(back.T, calibration.T);
  EXPECT_EQ(back.rectification->P2, calibration.rectification->P2);
  EXPECT_EQ(*back.mounting.down, *calibration.mounting.down);
  EXPECT_FALSE(back.mounting.sensor_height_m.has_value());

  stereo_calibration_t bad = message;
  bad.R[0] = 2.0;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = message;
  bad.left.fx = -1.0;
  EXPECT_THROW(from_message(bad), MessageError);
}

Segments test_segments() {
  const Cloud cloud = from_message(to_message(camera_cloud()));
  Segments segments;
  segments.stamp = cloud.stamp;
  Segment person;
  person.seed_m = {0.1F, 0.2F, 2.0F};
  person.seed_kind = SeedKind::kHeadShape;
  RangeImage image;
  image.camera = *cloud.camera;
  image.full_width = cloud.width;
  image.full_height = cloud.height;
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    const bool inside = !cloud.is_hole(i) && i % 3 == 0;
    image.depth_m.push_back(cloud.points_m[i].z());
    image.labels.push_back(cloud.is_hole(i) ? PixelLabel::kUnknown
                                            : (inside ? PixelLabel::kPerson : PixelLabel::kOther));
    image.is_skin.push_back(i % 5 == 0 ? 1 : 0);
    if (!inside) continue;
    person.points_m.push_back(cloud.points_m[i]);
    person.is_skin.push_back(i % 5 == 0 ? 1 : 0);
  }
  person.range_image = image;
  Segment rejected;
  rejected.id = 1;
  rejected.rejected_by = SegmentFilter::kTooFewPoints;
  rejected.filter_figure = 12.0F;
  rejected.filter_limit = 300.0F;
  rejected.points_m = {{0.5F, 0.5F, 2.0F}};
  segments.segments = {person, rejected};
  return segments;
}

TEST(SegmentsCodec, GivesPointsWindowAndRejectionBack) {
  const Segments segments = test_segments();
  const Segments back = from_message(to_message(segments));
  ASSERT_EQ(back.segments.size(), 2U);
  EXPECT_EQ(back.segments[0].points_m, segments.segments[0].points_m);
  EXPECT_EQ(back.segments[0].is_skin, segments.segments[0].is_skin);
  EXPECT_EQ(back.segments[0].range_image->labels, segments.segments[0].range_image->labels);
  EXPECT_EQ(back.segments[0].range_image->depth_m, segments.segments[0].range_image->depth_m);
  EXPECT_TRUE(back.segments[0].image_poses.empty());
  EXPECT_EQ(back.segments[1].rejected_by, SegmentFilter::kTooFewPoints);
  EXPECT_EQ(back.segments[1].filter_figure, 12.0F);
  EXPECT_EQ(back.segments[1].points_m.size(), 1U);
}

TEST(SegmentsCodec, RejectsWindowsAndPointsThatDoNotFit) {
  const segments_t good = to_message(test_segments());
  segments_t bad = good;
  bad.segments[0].num_points += 1;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.segments[0].windows[0].width = 39;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.segments[1].seed_m[0] = kNaN;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.segments[0].windows[0].frame_from_image[0] = 3.0F;
  EXPECT_THROW(from_message(bad), MessageError);
}

TEST(BodyPosesCodec, CarriesJointsPointingAndFigures) {
  BodyPoses poses;
  poses.stamp = test_stamp();
  BodyPose pose;
  pose.id = 3;
  pose[Joint::kHead] = {true, {0.1F, 0.2F, 2.0F}, 0.9F, 0.02F, false};
  pose.angles_rad.fill(kNaN);
  pose.error_terms = {1.0F, 2.0F, 3.0F, 4.0F};
  pose.pointing.push_back(
      {Side::kRight, {0.0F, 0.0F, -1.0F}, {0.0F, 0.0F, -1.0F}, {0.0F, 0.6F, -0.8F}, 0.02F, 0.97F});
  poses.persons = {pose};
  const BodyPoses back = from_message(to_message(poses));
  ASSERT_EQ(back.persons.size(), 1U);
  EXPECT_TRUE(back.persons[0][Joint::kHead].valid);
  EXPECT_EQ(back.persons[0][Joint::kHead].position_m, pose[Joint::kHead].position_m);
  EXPECT_FALSE(back.persons[0][Joint::kNeck].valid);
  EXPECT_EQ(back.persons[0].pointing[0].side, Side::kRight);
  EXPECT_EQ(back.persons[0].error_terms, pose.error_terms);
}

TEST(BodyPosesCodec, RejectsWrongNamesAndNumbers) {
  BodyPoses poses;
  poses.stamp = test_stamp();
  poses.persons.resize(1);
  poses.persons[0][Joint::kHead].valid = true;
  const body_poses_t good = to_message(poses);
  body_poses_t bad = good;
  bad.persons[0].joints[0].name = "tail";
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.persons[0].joints[0].position_m[2] = kInfinity;
  EXPECT_THROW(from_message(bad), MessageError);
}

TEST(Decode, RejectsForeignAndTruncatedBytes) {
  const point_cloud_t message = to_message(camera_cloud());
  std::vector<std::uint8_t> bytes(message.getEncodedSize());
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  EXPECT_NO_THROW(decode<point_cloud_t>(bytes));
  EXPECT_THROW(decode<segments_t>(bytes), MessageError);
  for (const std::size_t size : {0U, 4U, 8U, 40U, 100U}) {
    std::vector<std::uint8_t> torn(bytes.begin(),
                                   bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(decode<point_cloud_t>(torn), MessageError) << size << " bytes";
  }
}

}  // namespace
}  // namespace limbcast::lcm_io
