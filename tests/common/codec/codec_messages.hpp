#pragma once

#include <algorithm>
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

/// Messages in which every field says something.
namespace limbcast::lcm_io {

inline stamp_t stamp_message() {
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

inline body_poses_t body_poses_message() {
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

inline lens_t lens_message(double first) {
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

inline mounting_t mounting_message() {
  mounting_t message{};
  message.has_down = 1;
  message.down[1] = 0.8;
  message.down[2] = 0.6;
  message.sensor_height_m = 1.3;
  return message;
}

inline stereo_calibration_t calibration_message() {
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

inline cv::Mat noise_image(int type) {
  cv::Mat image(12, 16, type);
  cv::randu(image, 1, 250);
  return image;
}

/// A person in a turned window of a lattice, so that the points are told by themselves.
inline segments_t segments_message() {
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
  segment.image_poses = {{0.6F,
                          {{Joint::kHead, {12.5F, -3.0F}, 0.9F, -0.2F},
                           {Joint::kAnkleRight, {30.0F, 700.0F}, 0.1F, 0.3F, 0.02F}}},
                         {},
                         {0.5F, {{Joint::kHead, {13.0F, -2.0F}, 0.8F, 0.0F}}}};
  segment.rejected_by = SegmentFilter::kNotHeadShaped;
  segment.filter_figure = 12.0F;
  segment.filter_limit = 300.0F;
  segment.points_m = {{0.5F, -0.5F, 2.0F}, {-33.0F, 1.0F, 60.0F}};
  segment.is_skin = {0, 1};
  segment.range_image = image;
  return to_message({from_message(stamp_message()), {segment}});
}

inline Cloud small_cloud() {
  Cloud cloud;
  cloud.stamp = from_message(stamp_message());
  cloud.width = 16;
  cloud.height = 16;
  cloud.camera = PinholeCamera{16, 16, 50.0, 51.0, 7.0, 8.0};
  cloud.points_m.assign(256, {0.0F, 0.0F, 2.0F});
  cloud.colors.assign(256, {10, 120, 200});
  return cloud;
}

}  // namespace limbcast::lcm_io
