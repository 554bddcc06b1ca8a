#include "common/lcm_io/segments_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/lcm_io/compression.hpp"
#include "common/lcm_io/message_error.hpp"
#include "common/lcm_io/plausible.hpp"
#include "common/lcm_io/quantization.hpp"
#include "common/lcm_io/stamp_codec.hpp"

namespace limbcast::lcm_io {
namespace {

constexpr int kMaxWindowSide = 8192;
/// A joint of somebody close by may lie far beyond the image's edge; nothing lies farther [px].
constexpr float kFarthestJoint_px = 1e6F;
constexpr std::size_t kMostImagePoses = kImageNetworkCount;
constexpr std::int32_t kMaxSegmentPoints = 8'000'000;
constexpr std::uint8_t kLabelMask = 0x03;
constexpr std::uint8_t kSkinBit = 0x04;

bool points_lie_in_window(const Segment& segment) {
  return segment.range_image && segment.range_image->frame_from_image.isIdentity();
}

range_image_t to_message(const RangeImage& image, const DepthNoise& noise) {
  range_image_t message{};
  message.width = image.camera.width;
  message.height = image.camera.height;
  message.fx = image.camera.fx;
  message.fy = image.camera.fy;
  message.cx = image.camera.cx;
  message.cy = image.camera.cy;
  message.origin_u = image.origin_u;
  message.origin_v = image.origin_v;
  message.full_width = image.full_width;
  message.full_height = image.full_height;
  for (int i = 0; i < 9; ++i) message.frame_from_image[i] = image.frame_from_image(i / 3, i % 3);
  message.inverse_depth_scale = inverse_depth_scale(noise);
  message.depth = encode_lattice(quantize_depths(image.depth_m, message.inverse_depth_scale),
                                 image.camera.width, image.camera.height);
  message.depth_size = static_cast<std::int32_t>(message.depth.size());
  message.has_skin = image.is_skin.empty() ? 0 : 1;
  std::vector<std::uint8_t> labels(image.labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool skin = !image.is_skin.empty() && image.is_skin[i] != 0;
    labels[i] = static_cast<std::uint8_t>(static_cast<std::uint8_t>(image.labels[i]) |
                                          (skin ? kSkinBit : 0));
  }
  message.labels = compress(labels);
  message.labels_size = static_cast<std::int32_t>(message.labels.size());
  return message;
}

void read_labels(const range_image_t& message, RangeImage& image) {
  const std::vector<std::uint8_t> labels = decompress(message.labels, image.depth_m.size());
  image.labels.resize(labels.size());
  if (message.has_skin != 0) image.is_skin.resize(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::uint8_t label = labels[i] & kLabelMask;
    require(label <= static_cast<std::uint8_t>(PixelLabel::kOther),
            "segments: unknown pixel label");
    image.labels[i] = static_cast<PixelLabel>(label);
    // A person's pixel without depth would be a point at the sensor's origin.
    require(image.labels[i] != PixelLabel::kPerson || image.depth_m[i] > 0.0F,
            "segments: a person's pixel has no depth");
    if (message.has_skin != 0) image.is_skin[i] = (labels[i] & kSkinBit) != 0 ? 1 : 0;
  }
}

RangeImage from_message(const range_image_t& message) {
  require(message.width > 0 && message.height > 0 && message.width <= kMaxWindowSide &&
              message.height <= kMaxWindowSide,
          "segments: size of a window is out of range");
  require(std::isfinite(message.inverse_depth_scale) && message.inverse_depth_scale > 0.0,
          "segments: 'inverse_depth_scale' is not positive");
  RangeImage image;
  image.camera = {message.width, message.height, message.fx, message.fy, message.cx, message.cy};
  require(is_plausible(image.camera), "segments: camera of a window is not sound");
  require(std::abs(static_cast<std::int64_t>(message.origin_u)) <= kMaxWindowSide &&
              std::abs(static_cast<std::int64_t>(message.origin_v)) <= kMaxWindowSide &&
              message.full_width >= 0 && message.full_width <= kMaxWindowSide &&
              message.full_height >= 0 && message.full_height <= kMaxWindowSide,
          "segments: place of a window is out of range");
  image.origin_u = message.origin_u;
  image.origin_v = message.origin_v;
  image.full_width = message.full_width;
  image.full_height = message.full_height;
  for (int i = 0; i < 9; ++i) image.frame_from_image(i / 3, i % 3) = message.frame_from_image[i];
  constexpr float kRotationTolerance = 1e-3F;
  require(
      (image.frame_from_image * image.frame_from_image.transpose() - Eigen::Matrix3f::Identity())
              .norm() < kRotationTolerance,
      "segments: rotation of a window is none");
  image.depth_m = dequantize_depths(decode_lattice(message.depth, message.width, message.height),
                                    message.inverse_depth_scale);
  require(std::all_of(image.depth_m.begin(), image.depth_m.end(),
                      [](float depth_m) { return depth_m <= kFarthest_m; }),
          "segments: a depth is farther than any sensor sees");
  read_labels(message, image);
  return image;
}

void write_points(const Segment& segment, segment_t& message) {
  message.has_points = 1;
  message.resolution_m = list_resolution_m(segment.points_m);
  message.points = encode_sequence(quantize_points(segment.points_m, message.resolution_m));
  message.points_size = static_cast<std::int32_t>(message.points.size());
  message.skin = segment.is_skin;
  message.skin_size = static_cast<std::int32_t>(message.skin.size());
}

void read_points(const segment_t& message, Segment& segment) {
  require(std::isfinite(message.resolution_m) && message.resolution_m > 0.0,
          "segments: 'resolution_m' is not positive");
  segment.points_m = dequantize_points(
      decode_sequence(message.points, static_cast<std::size_t>(message.num_points) * 3),
      message.resolution_m);
  segment.is_skin = message.skin;
  require(segment.is_skin.empty() || segment.is_skin.size() == segment.points_m.size(),
          "segments: skin flags do not fit the points");
}

void read_points_of_window(Segment& segment) {
  const RangeImage& image = *segment.range_image;
  for (int v = 0, i = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u, ++i) {
      if (image.labels[i] != PixelLabel::kPerson) continue;
      segment.points_m.push_back(image.camera.back_project(
          static_cast<float>(u), static_cast<float>(v), image.depth_m[i]));
      if (!image.is_skin.empty()) segment.is_skin.push_back(image.is_skin[i]);
    }
  }
}

image_pose_t to_message(const ImagePose& pose) {
  image_pose_t message{};
  message.person_score = pose.person_score;
  for (const ImageJoint& joint : pose.joints) {
    image_joint_t& joint_message = message.joints.emplace_back();
    joint_message.joint = static_cast<std::int8_t>(index(joint.joint));
    joint_message.u = joint.px.x();
    joint_message.v = joint.px.y();
    joint_message.visibility = joint.visibility;
    joint_message.behind_hips_m = joint.behind_hips_m;
    joint_message.spread_m = joint.spread_m;
  }
  message.num_joints = static_cast<std::int32_t>(message.joints.size());
  return message;
}

ImagePose from_message(const image_pose_t& message) {
  require(is_share(message.person_score),
          "segments: score of a person of an image is out of range");
  ImagePose pose;
  pose.person_score = message.person_score;
  std::array<bool, kJointCount> told{};
  for (const image_joint_t& joint : message.joints) {
    require(joint.joint >= 0 && joint.joint < kJointCount, "segments: unknown joint of an image");
    require(!std::exchange(told[joint.joint], true), "segments: a joint of an image is told twice");
    require(std::abs(joint.u) <= kFarthestJoint_px && std::abs(joint.v) <= kFarthestJoint_px &&
                is_share(joint.visibility) && std::abs(joint.behind_hips_m) <= kFarthest_m &&
                joint.spread_m >= 0.0F && joint.spread_m <= kFarthest_m,
            "segments: a joint of an image is out of range");
    pose.joints.push_back({static_cast<Joint>(joint.joint),
                           {joint.u, joint.v},
                           joint.visibility,
                           joint.behind_hips_m,
                           joint.spread_m});
  }
  return pose;
}

segment_t to_message(const Segment& segment, const DepthNoise& noise) {
  segment_t message{};
  message.id = segment.id;
  for (int i = 0; i < 3; ++i) message.seed_m[i] = segment.seed_m[i];
  message.seed_kind = static_cast<std::int8_t>(segment.seed_kind);
  message.seed_score = segment.seed_score;
  message.facing_log_odds = segment.face.facing_log_odds;
  message.looks_right_log_odds = segment.face.looks_right_log_odds;
  for (const ImagePose& pose : segment.image_poses) message.image_poses.push_back(to_message(pose));
  message.num_image_poses = static_cast<std::int32_t>(message.image_poses.size());
  message.rejected_by = static_cast<std::int8_t>(segment.rejected_by);
  message.filter_figure = segment.filter_figure;
  message.filter_limit = segment.filter_limit;
  message.num_points = static_cast<std::int32_t>(segment.points_m.size());
  if (!points_lie_in_window(segment)) write_points(segment, message);
  if (segment.range_image) message.windows.push_back(to_message(*segment.range_image, noise));
  message.num_windows = static_cast<std::int32_t>(message.windows.size());
  return message;
}

Segment from_message(const segment_t& message) {
  Segment segment;
  segment.id = message.id;
  segment.seed_m = {message.seed_m[0], message.seed_m[1], message.seed_m[2]};
  require(segment.seed_m.allFinite(), "segments: seed is not finite");
  require(message.seed_kind >= segment_t::SEED_SKIN && message.seed_kind <= segment_t::SEED_BODY,
          "segments: unknown 'seed_kind'");
  segment.seed_kind = static_cast<SeedKind>(message.seed_kind);
  require(std::isfinite(message.seed_score) && std::isfinite(message.filter_figure) &&
              std::isfinite(message.filter_limit),
          "segments: a seed's score or a filter's figure is not finite");
  segment.seed_score = message.seed_score;
  require(std::isfinite(message.facing_log_odds) && std::isfinite(message.looks_right_log_odds),
          "segments: odds of a face are not finite");
  segment.face = {message.facing_log_odds, message.looks_right_log_odds};
  require(message.image_poses.size() <= kMostImagePoses,
          "segments: too many poses of a person in the image");
  for (const image_pose_t& pose : message.image_poses)
    segment.image_poses.push_back(from_message(pose));
  require(
      message.rejected_by >= segment_t::VALID && message.rejected_by <= segment_t::NOT_HEAD_SHAPED,
      "segments: unknown 'rejected_by'");
  segment.rejected_by = static_cast<SegmentFilter>(message.rejected_by);
  segment.filter_figure = message.filter_figure;
  segment.filter_limit = message.filter_limit;
  require(message.num_points >= 0 && message.num_points <= kMaxSegmentPoints,
          "segments: number of points is out of range");
  require(message.windows.size() <= 1, "segments: more than one window");
  if (!message.windows.empty()) segment.range_image = from_message(message.windows.front());
  if (message.has_points != 0) {
    read_points(message, segment);
  } else {
    require(segment.range_image.has_value(), "segments: neither points nor window");
    read_points_of_window(segment);
    require(segment.points_m.size() == static_cast<std::size_t>(message.num_points),
            "segments: 'num_points' differs from the window's person pixels");
  }
  return segment;
}

}  // namespace

segments_t to_message(const Segments& segments) {
  segments_t message{};
  message.stamp = to_message(segments.stamp);
  for (const Segment& segment : segments.segments)
    message.segments.push_back(to_message(segment, segments.stamp.depth_noise));
  message.num_segments = static_cast<std::int32_t>(message.segments.size());
  return message;
}

Segments from_message(const segments_t& message) {
  Segments segments;
  segments.stamp = from_message(message.stamp);
  for (const segment_t& segment : message.segments)
    segments.segments.push_back(from_message(segment));
  return segments;
}

}  // namespace limbcast::lcm_io
