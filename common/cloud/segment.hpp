#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "common/human_model/joints.hpp"

namespace limbcast {

enum class SeedKind : std::int8_t {
  kSkin = 0,
  kHeadShape = 1,
  kBoth = 2,  ///< a head's shape, and skin
  kBody = 3,  ///< a body whose head is out of sight: the seed is a guess of where it is
};

/// The filters of section III-B.2 of the paper, and what else ends a candidate.
enum class SegmentFilter : std::int8_t {
  kNone = 0,           ///< valid
  kTooFewPoints = 1,   ///< figure: points
  kTooManyPoints = 2,  ///< figure: points
  kSeedNotHead = 3,    ///< figure: seed over the centroid, below the limit; or beside it, above [m]
  kTooSparse = 4,      ///< figure: share of the cluster's outline that is filled
  kSamePerson = 5,     ///< figure: share of the cluster that a better seed holds too
  kNotHeadShaped = 6,  ///< figure, 0 to 1: probability of a head, or of a person or a body where
                       ///< that was too low; or the share of the cluster that is a body's
};

/// What a pixel of a range image shows.
enum class PixelLabel : std::uint8_t {
  kUnknown = 0,  ///< hole: nothing was measured
  kPerson = 1,   ///< point of this segment
  kOther = 2,    ///< measured, not this person: behind it or in front of it, the depth says which
};

/// The part of the sensor's lattice around a person: what belongs to it, what the sensor saw
/// beside, behind and in front. `camera` is the crop's own (principal point moved), `origin_*` its
/// place in the full image of `full_width` x `full_height`, so that a border of the crop is told
/// from one of the image.
struct RangeImage {
  PinholeCamera camera;
  int origin_u = 0, origin_v = 0;       ///< [px]
  int full_width = 0, full_height = 0;  ///< [px]
  std::vector<float> depth_m;           ///< camera.width * camera.height, 0 = hole
  std::vector<PixelLabel> labels;       ///< same size
  std::vector<std::uint8_t> is_skin;    ///< same size, 1 = skin-coloured; empty without colour
  /// Rotation from the range image's optical frame to Stamp::frame. Identity for a camera's cloud;
  /// for an unorganised one (laser) the image is rendered from the sensor's origin towards the
  /// person.
  Eigen::Matrix3f frame_from_image = Eigen::Matrix3f::Identity();
};

/// What looking for a face at a person's head told. Zero: nothing.
struct FaceEvidence {
  /// Log odds that the person faces the sensor rather than away.
  float facing_log_odds = 0.0F;
  /// Log odds that the face looks to the right, as the sensor sees it, rather than to the left.
  float looks_right_log_odds = 0.0F;
};

/// The networks that see people's joints, in the order in which a segment holds what they see.
enum class ImageNetwork : std::int8_t {
  kBlazePose,  ///< in the colour image
  kMoveNet,    ///< in the colour image
  kDepthPose,  ///< limbcast's own, in the depths
};
inline constexpr int kImageNetworkCount = 3;

/// One joint of a person as a network sees it.
struct ImageJoint {
  Joint joint = Joint::kHead;
  Eigen::Vector2f px =
      Eigen::Vector2f::Zero();  ///< in the cloud's lattice (a list: in `range_image`), or beyond
  float visibility = 0.0F;      ///< 0 to 1, how sure the joint is in sight and there
  /// How much farther along the optical axis than the hips' middle; rough of BlazePose: of one
  /// wrist in eight the sign is wrong. 0 of MoveNet, which tells none.
  float behind_hips_m = 0.0F;
  /// How far off the mark is across the ray (standard deviation), in sight or not. 0 of BlazePose
  /// and MoveNet, which do not tell it.
  float spread_m = 0.0F;
};

/// A person as a network for poses sees it.
struct ImagePose {
  float person_score = 0.0F;       ///< 0 to 1, how sure the network is that somebody is there
  std::vector<ImageJoint> joints;  ///< those that the network knows, each once; none: no look
};

/// One person candidate: a cluster of points grown from a seed.
struct Segment {
  std::int32_t id = 0;                               ///< number within the frame
  Eigen::Vector3f seed_m = Eigen::Vector3f::Zero();  ///< where growing started, on the surface
  SeedKind seed_kind = SeedKind::kSkin;
  float seed_score = 0.0F;  ///< 0 to 1, how sure the seed is a head (kBody: of a person)
  FaceEvidence face;
  /// As each ImageNetwork sees the person; ends with the last one that looked.
  std::vector<ImagePose> image_poses;
  SegmentFilter rejected_by = SegmentFilter::kNone;
  float filter_figure = 0.0F;             ///< what the rejecting filter measured
  float filter_limit = 0.0F;              ///< against what
  std::vector<Eigen::Vector3f> points_m;  ///< the cluster, on the surface the sensor saw
  std::vector<std::uint8_t> is_skin;      ///< one for each point, or empty without colour
  std::optional<RangeImage> range_image;

  bool valid() const { return rejected_by == SegmentFilter::kNone; }
};

struct Segments {
  Stamp stamp;
  std::vector<Segment> segments;
};

}  // namespace limbcast
