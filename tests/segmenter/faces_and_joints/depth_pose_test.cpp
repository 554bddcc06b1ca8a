#include "modules/segmenter/faces_and_joints/depth_pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "modules/segmenter/faces_and_joints/depth_picture.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/turned_cloud.hpp"
#include "tests/support/demo_frame.hpp"

namespace limbcast::segmenter {
namespace {

const Eigen::Vector3f kDown(0.0F, 1.0F, 0.0F);

/// Whose each point is: somebody's, or nobody's.
constexpr std::int16_t kOwn = 0;

/// A camera's view of 100 x 100 px over 90 degrees of a wall that is all somebody's own.
struct Wall {
  explicit Wall(float depth_m = 2.0F) {
    cloud.camera = PinholeCamera{100, 100, 50.0, 50.0, 49.5, 49.5};
    cloud.width = cloud.height = 100;
    for (int v = 0; v < cloud.height; ++v) {
      for (int u = 0; u < cloud.width; ++u)
        cloud.points_m.push_back(
            cloud.camera->back_project(static_cast<float>(u), static_cast<float>(v), depth_m));
    }
    labels.assign(cloud.points_m.size(), kOwn);
  }
  Wall& not_own() {
    labels.assign(labels.size(), kNobody);
    return *this;
  }
  /// Its middle is straight ahead and 2 m away.
  std::optional<DepthPicture> drawn() const {
    return draw_depths(look_at(cloud, {}), {labels, kOwn, head_m}, {});
  }
  DepthPicture picture() const { return drawn().value(); }

  Cloud cloud;
  std::vector<std::int16_t> labels;
  Eigen::Vector3f head_m =
      Eigen::Vector3f(0.0F, 0.0F, 2.0F) - DepthPictureParams{}.middle_below_head_m * kDown;
};

cv::Vec4f middle_of(const Wall& wall) {
  return wall.picture().channels(kDepthPictureSide_px / 2, kDepthPictureSide_px / 2);
}

void expect_near(const cv::Vec4f& seen, const cv::Vec4f& expected) {
  constexpr double kRounding = 1e-3;
  EXPECT_LT(cv::norm(seen - expected), kRounding) << seen << expected;
}

DepthPicture picture_of(const Cloud& cloud, const LabelledPerson& person) {
  return draw_depths(look_at(cloud, {}), person, {}).value();
}

/// The same points as a range finder tells them: a list.
Cloud as_scan(Cloud cloud) {
  cloud.camera.reset();
  cloud.colors.clear();
  cloud.width = static_cast<int>(cloud.points_m.size());
  cloud.height = 1;
  return cloud;
}

Eigen::Vector3f in_mirror(const Eigen::Vector3f& v) { return {-v.x(), v.y(), v.z()}; }

template <class Value>
std::vector<Value> rows_in_mirror(std::vector<Value> values, int width) {
  for (std::size_t row = 0; row < values.size(); row += static_cast<std::size_t>(width)) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row);
    std::reverse(begin, begin + width);
  }
  return values;
}

/// Without colours.
Cloud in_mirror(const Cloud& cloud) {
  Cloud mirror = cloud;
  mirror.colors.clear();
  mirror.camera->cx = cloud.width - 1 - cloud.camera->cx;
  mirror.points_m = rows_in_mirror(cloud.points_m, cloud.width);
  for (Eigen::Vector3f& point_m : mirror.points_m) point_m = in_mirror(point_m);
  mirror.stamp.gravity.down = in_mirror(cloud.stamp.gravity.down);
  return mirror;
}

/// The points of the cloud that a segment's view calls its own.
std::vector<std::int16_t> labels_of(const Segment& segment, const Cloud& cloud) {
  const RangeImage& view = segment.range_image.value();
  std::vector<std::int16_t> labels(cloud.points_m.size(), kNobody);
  for (std::size_t i = 0; i < view.labels.size(); ++i) {
    const auto width = static_cast<std::size_t>(view.camera.width);
    const std::size_t u = i % width + static_cast<std::size_t>(view.origin_u),
                      v = i / width + static_cast<std::size_t>(view.origin_v);
    if (view.labels[i] == PixelLabel::kPerson)
      labels[v * static_cast<std::size_t>(cloud.width) + u] = kOwn;
  }
  return labels;
}

TEST(DepthPicture, ShowsThePersonsOwnDepthsAgainstTheMiddle) {
  const DepthPictureParams params;
  expect_near(middle_of(Wall()), {1.0F, 0.0F, 0.0F, 0.0F});
  expect_near(middle_of(Wall(2.25F)), {1.0F, 0.25F / params.unit_m, 0.0F, 0.0F});
  expect_near(middle_of(Wall(9.0F)), {1.0F, params.most_units, 0.0F, 0.0F});
}

TEST(DepthPicture, ShowsWhatElseStandsBeforeAndBehindAndHowFar) {
  const DepthPictureParams params;
  expect_near(middle_of(Wall(2.25F).not_own()), {0.0F, 0.0F, 1.0F, 0.25F / params.unit_m});
  expect_near(middle_of(Wall(1.75F).not_own()), {0.0F, 0.0F, -1.0F, -0.25F / params.unit_m});
  expect_near(middle_of(Wall(9.0F).not_own()), {0.0F, 0.0F, 1.0F, params.most_units});
  Wall hole;
  hole.cloud.points_m.assign(hole.cloud.points_m.size(), Eigen::Vector3f::Zero());
  expect_near(middle_of(hole), {});
}

TEST(DepthPicture, ShowsWhatMayBeThePersonsAsSomethingElse) {
  Wall wall;
  wall.labels.assign(wall.labels.size(), kUnsure);
  expect_near(middle_of(wall), {0.0F, 0.0F, 1.0F, 0.0F});
}

TEST(DepthPicture, ShowsTheSameOfAScan) {
  Wall scan(2.25F);
  scan.cloud = as_scan(std::move(scan.cloud));
  const cv::Vec4f camera = middle_of(Wall(2.25F)), seen = middle_of(scan);
  // A pixel between points takes the nearest one's level distance.
  constexpr double kNearestPoint = 0.01;
  EXPECT_LT(cv::norm(seen - camera), kNearestPoint) << seen << camera;
}

TEST(DepthPicture, IsAsWideAsToldAroundTheMiddle) {
  const DepthPictureParams params;
  const DepthPicture picture = Wall().picture();
  EXPECT_FLOAT_EQ(picture.middle_m, 2.0F);
  const auto at_edge = [&](float px) {
    return picture.camera.back_project(px, px, picture.middle_m).x();
  };
  EXPECT_NEAR(at_edge(kDepthPictureSide_px - 0.5F) - at_edge(-0.5F), params.side_m, 1e-3F);
}

TEST(DepthPicture, IsEmptyBesideTheView) {
  Wall wall;
  wall.cloud.camera->cx -= 1000.0;
  expect_near(middle_of(wall), {});
}

TEST(DepthPicture, IsNoneOfSomebodyStraightAbove) {
  Wall wall;
  wall.head_m.setZero();
  EXPECT_FALSE(wall.drawn());
}

/// The person of the demo log's first frame, as a camera without colours sees it.
class DepthsOfTheDemo : public ::testing::Test {
 protected:
  static Cloud colorless(Cloud cloud) {
    cloud.colors.clear();
    return cloud;
  }
  static ImagePose seen_in(const Cloud& cloud, const Params& params = {}) {
    return Segmenter(params)
        .segment(colorless(cloud))
        .segments.at(0)
        .image_poses.at(static_cast<std::size_t>(ImageNetwork::kDepthPose));
  }

  const test::DemoFrame& frame_ = test::demo_frame();
  const BodyPose& person_ = frame_.truth.persons.at(0);
  const Cloud cloud_ = colorless(frame_.cloud);
  const std::vector<std::int16_t> labels_ = labels_of(segment(cloud_).segments.at(0), cloud_);
};

TEST_F(DepthsOfTheDemo, ShowEachJointAndItsSideWithoutColors) {
  constexpr float kNear_m = 0.10F;
  for (const bool hangs_sideways : {false, true}) {
    const Cloud cloud = hangs_sideways ? turned(frame_.cloud) : frame_.cloud;
    const ImagePose pose = seen_in(cloud);
    ASSERT_EQ(pose.joints.size(), static_cast<std::size_t>(kJointCount));
    EXPECT_GT(pose.person_score, 0.7F);
    const Eigen::Vector3f pelvis_m = person_[Joint::kPelvis].position_m;
    for (const ImageJoint& joint : pose.joints) {
      const Eigen::Vector3f upright_m = person_[joint.joint].position_m;
      const Eigen::Vector3f truth_m = hangs_sideways ? turned(upright_m) : upright_m;
      const Eigen::Vector3f told_m =
          cloud.camera->back_project(joint.px.x(), joint.px.y(), truth_m.z());
      EXPECT_LT((told_m - truth_m).norm(), kNear_m) << kJointNames[index(joint.joint)];
      EXPECT_NEAR(joint.behind_hips_m, upright_m.z() - pelvis_m.z(), kNear_m)
          << kJointNames[index(joint.joint)];
    }
  }
}

TEST_F(DepthsOfTheDemo, ShowTheSameInTheMirror) {
  const Cloud mirror = in_mirror(cloud_);
  const auto mirror_labels = rows_in_mirror(labels_, cloud_.width);
  const Eigen::Vector3f head_m = person_[Joint::kHead].position_m;
  const DepthPose network{DepthPoseParams{}};
  const auto seen = network.look(picture_of(cloud_, {labels_, kOwn, head_m}));
  const auto mirrored_seen =
      network.look(picture_of(mirror, {mirror_labels, kOwn, in_mirror(head_m)}));
  ASSERT_TRUE(seen && mirrored_seen);
  // Nearest pixels of the view are taken: one may be another in the mirror.
  constexpr float kNear_m = 0.02F;
  EXPECT_NEAR(seen->person_score, mirrored_seen->person_score, 0.01F);
  for (int i = 0; i < kJointCount; ++i) {
    const Eigen::Vector3f& place_m = seen->places_m.at(static_cast<std::size_t>(i));
    const Eigen::Vector3f& other_m =
        mirrored_seen->places_m.at(static_cast<std::size_t>(mirrored(i)));
    EXPECT_LT((place_m - in_mirror(other_m)).norm(), kNear_m)
        << kJointNames[static_cast<std::size_t>(i)];
  }
}

TEST_F(DepthsOfTheDemo, ShowAnArmThatIsCutOffAsSomethingElse) {
  const PinholeCamera& camera = *cloud_.camera;
  const Eigen::Vector3f& wrist_m = person_[Joint::kWristLeft].position_m;
  constexpr float kCut_m = 0.15F;
  std::vector<std::int16_t> without_hand = labels_;
  for (std::size_t i = 0; i < without_hand.size(); ++i) {
    if ((cloud_.points_m[i] - wrist_m).norm() < kCut_m) without_hand[i] = kNobody;
  }
  ASSERT_NE(without_hand, labels_);
  const auto seen =
      DepthPose(DepthPoseParams{})
          .look(picture_of(cloud_, {without_hand, kOwn, person_[Joint::kHead].position_m}));
  ASSERT_TRUE(seen);
  constexpr float kNear_m = 0.06F;
  const Eigen::Vector3f& told_m = seen->places_m[index(Joint::kWristLeft)];
  const Eigen::Vector2f told_px = camera.project(told_m), px = camera.project(wrist_m);
  EXPECT_LT((told_px - px).norm() * wrist_m.z() / camera.fx, kNear_m);
}

TEST_F(DepthsOfTheDemo, TellHowUnsureTheyAreWhereAnArmIs) {
  const auto spread_m = [&](const std::vector<std::int16_t>& labels) {
    const auto seen =
        DepthPose(DepthPoseParams{})
            .look(picture_of(cloud_, {labels, kOwn, person_[Joint::kHead].position_m}));
    return seen.value().spreads_m[index(Joint::kWristLeft)];
  };
  constexpr float kUsual_m = 0.02F;
  EXPECT_NEAR(spread_m(labels_), kUsual_m, 0.5F * kUsual_m);
  EXPECT_GT(spread_m(std::vector<std::int16_t>(labels_.size(), kUnsure)), 2.0F * kUsual_m);
}

TEST_F(DepthsOfTheDemo, ShowAPersonAndDoNotShowOneInAWall) {
  constexpr float kSure = 0.9F;
  EXPECT_GT(seen_in(frame_.cloud).person_score, kSure);
  const Wall wall;
  const auto seen = DepthPose(DepthPoseParams{}).look(wall.picture());
  ASSERT_TRUE(seen);
  EXPECT_LT(seen->person_score, 1.0F - kSure);
}

TEST_F(DepthsOfTheDemo, TellWhetherAPersonIsThereAsALookDoes) {
  const DepthPose network{DepthPoseParams{}};
  constexpr float kSure = 4.0F;
  EXPECT_TRUE(network.see_person(
      picture_of(cloud_, {labels_, kOwn, person_[Joint::kHead].position_m}), kSure));
  // To the network something else in the mirror.
  Wall wall_on_the_left;
  for (std::size_t i = 0; i < wall_on_the_left.labels.size(); ++i) {
    const auto width = static_cast<std::size_t>(wall_on_the_left.cloud.width);
    if (i % width > width / 2) wall_on_the_left.labels[i] = kNobody;
  }
  const DepthPicture picture = wall_on_the_left.picture();
  const auto wall_is_over = [&](float odds) {
    return network.see_person(picture, odds).has_value();
  };
  EXPECT_FALSE(wall_is_over(kSure));
  const float odds = log_odds(network.look(picture)->person_score);
  constexpr float kRounding = 0.01F;
  // The second network, which may be the surer one here, must be so by more than what is asked.
  EXPECT_TRUE(wall_is_over(odds - DepthPoseParams{}.bent_surer_by - kRounding)) << odds;
  EXPECT_FALSE(wall_is_over(odds + kRounding)) << odds;
}

TEST_F(DepthsOfTheDemo, ShowTheSameToPortableNetworks) {
  Params portable;
  portable.depth_pose.library = NetworkLibrary::kXnnpack;
  const ImagePose quick = seen_in(frame_.cloud), other = seen_in(frame_.cloud, portable);
  for (std::size_t i = 0; i < quick.joints.size(); ++i) {
    EXPECT_LT((quick.joints[i].px - other.joints[i].px).norm(), 2.0F) << kJointNames[i];
    EXPECT_NEAR(quick.joints[i].behind_hips_m, other.joints[i].behind_hips_m, 0.03F)
        << kJointNames[i];
  }
}

TEST_F(DepthsOfTheDemo, AreShownToANetworkOfScansWhereTheyAreOfOne) {
  const DepthPose networks{DepthPoseParams{}};
  DepthPicture picture =
      picture_of(as_scan(cloud_), {labels_, kOwn, person_[Joint::kHead].position_m});
  const auto in_scan = networks.look(picture);
  ASSERT_TRUE(picture.of_scan && in_scan);
  picture.of_scan = false;
  EXPECT_NE(in_scan->places_m, networks.look(picture)->places_m);
  constexpr float kNear_m = 0.10F;
  for (std::size_t i = 0; i < in_scan->places_m.size(); ++i) {
    const Eigen::Vector3f& truth_m = person_[static_cast<Joint>(i)].position_m;
    EXPECT_LT((in_scan->places_m.at(i) - truth_m).norm(), kNear_m) << kJointNames[i];
  }
}

TEST_F(DepthsOfTheDemo, AreAskedBesideTheColors) {
  const auto poses = segment(frame_.cloud).segments.at(0).image_poses;
  ASSERT_EQ(poses.size(), static_cast<std::size_t>(kImageNetworkCount));
  for (const ImagePose& pose : poses) EXPECT_FALSE(pose.joints.empty());
}

}  // namespace
}  // namespace limbcast::segmenter
