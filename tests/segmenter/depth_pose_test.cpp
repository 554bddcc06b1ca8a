#include "modules/segmenter/depth_pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "modules/segmenter/depth_picture.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/turned_cloud.hpp"
#include "tests/support/demo_frame.hpp"

namespace limbcast::segmenter {
namespace {

const Eigen::Vector3f kDown(0.0F, 1.0F, 0.0F);

/// A view of 100 x 100 px over 90 degrees in which everything is somebody's own and 2 m away.
RangeImage wall() {
  RangeImage view;
  view.camera = {100, 100, 50.0, 50.0, 49.5, 49.5};
  view.full_width = view.full_height = 100;
  view.depth_m.assign(10000, 2.0F);
  view.labels.assign(10000, PixelLabel::kPerson);
  return view;
}

/// Somebody's head so that the picture's middle is straight ahead, as far as the wall.
Eigen::Vector3f head_before_middle() {
  return Eigen::Vector3f(0.0F, 0.0F, 2.0F) - DepthPictureParams{}.middle_below_head_m * kDown;
}

cv::Vec3f middle_of(const RangeImage& view) {
  const auto picture = draw_depths(view, head_before_middle(), kDown, {});
  return picture.value().channels(kDepthPictureSide_px / 2, kDepthPictureSide_px / 2);
}

Eigen::Vector3f in_mirror(const Eigen::Vector3f& v) { return {-v.x(), v.y(), v.z()}; }

RangeImage in_mirror(const RangeImage& view) {
  RangeImage image = view;
  const int width = view.camera.width;
  image.camera.cx = width - 1 - view.camera.cx;
  image.origin_u = view.full_width - width - view.origin_u;
  for (std::size_t row = 0; row < view.depth_m.size(); row += static_cast<std::size_t>(width)) {
    const auto begin = static_cast<std::ptrdiff_t>(row), end = begin + width;
    std::reverse(image.depth_m.begin() + begin, image.depth_m.begin() + end);
    std::reverse(image.labels.begin() + begin, image.labels.begin() + end);
  }
  return image;
}

TEST(DepthPicture, ShowsThePersonsOwnDepthsAgainstTheMiddle) {
  RangeImage view = wall();
  EXPECT_EQ(middle_of(view), cv::Vec3f(1.0F, 0.0F, 0.0F));
  view.depth_m.assign(view.depth_m.size(), 2.25F);
  EXPECT_NEAR(middle_of(view)[1], 0.25F / DepthPictureParams{}.unit_m, 1e-4F);
  view.depth_m.assign(view.depth_m.size(), 9.0F);
  EXPECT_EQ(middle_of(view)[1], DepthPictureParams{}.most_units);
}

TEST(DepthPicture, ShowsWhatElseStandsBeforeAndBehind) {
  RangeImage view = wall();
  view.labels.assign(view.labels.size(), PixelLabel::kOther);
  view.depth_m.assign(view.depth_m.size(), 3.0F);
  EXPECT_EQ(middle_of(view), cv::Vec3f(0.0F, 0.0F, 1.0F));
  view.depth_m.assign(view.depth_m.size(), 1.0F);
  EXPECT_EQ(middle_of(view), cv::Vec3f(0.0F, 0.0F, -1.0F));
  view.depth_m.assign(view.depth_m.size(), 0.0F);
  EXPECT_EQ(middle_of(view), cv::Vec3f(0.0F, 0.0F, 0.0F));
}

TEST(DepthPicture, IsAsWideAsToldAroundTheMiddle) {
  const DepthPictureParams params;
  const DepthPicture picture = draw_depths(wall(), head_before_middle(), kDown, params).value();
  EXPECT_FLOAT_EQ(picture.middle_m, 2.0F);
  const auto at_edge = [&](float px) {
    return picture.camera.back_project(px, px, picture.middle_m).x();
  };
  EXPECT_NEAR(at_edge(kDepthPictureSide_px - 0.5F) - at_edge(-0.5F), params.side_m, 1e-3F);
}

TEST(DepthPicture, IsEmptyBesideTheView) {
  RangeImage view = wall();
  view.camera.cx -= 1000.0;
  EXPECT_EQ(middle_of(view), cv::Vec3f(0.0F, 0.0F, 0.0F));
}

TEST(DepthPicture, IsNoneOfSomebodyStraightAbove) {
  EXPECT_FALSE(draw_depths(wall(), Eigen::Vector3f::Zero(), kDown, {}));
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
  const RangeImage view = segment(colorless(frame_.cloud)).segments.at(0).range_image.value();
  const Eigen::Vector3f head_m = person_[Joint::kHead].position_m;
  const Eigen::Vector3f down = frame_.cloud.stamp.gravity.down;
  const DepthPose network{DepthPoseParams{}};
  const auto seen = network.look(view, head_m, down);
  const auto mirrored_seen = network.look(in_mirror(view), in_mirror(head_m), in_mirror(down));
  ASSERT_TRUE(seen && mirrored_seen);
  // Nearest pixels of the view are taken: one may be another in the mirror.
  constexpr float kOnePixel = 1.0F, kNear_m = 0.02F;
  EXPECT_NEAR(seen->person_score, mirrored_seen->person_score, 0.01F);
  for (int i = 0; i < kJointCount; ++i) {
    const ImageJoint& joint = seen->joints.at(static_cast<std::size_t>(i));
    const ImageJoint& other = mirrored_seen->joints.at(static_cast<std::size_t>(mirrored(i)));
    EXPECT_NEAR(joint.px.x() + other.px.x(), static_cast<float>(view.full_width - 1), kOnePixel)
        << kJointNames[static_cast<std::size_t>(i)];
    EXPECT_NEAR(joint.px.y(), other.px.y(), kOnePixel) << kJointNames[static_cast<std::size_t>(i)];
    EXPECT_NEAR(joint.behind_hips_m, other.behind_hips_m, kNear_m)
        << kJointNames[static_cast<std::size_t>(i)];
  }
}

TEST_F(DepthsOfTheDemo, ShowAPersonAndDoNotShowOneInAWall) {
  constexpr float kSure = 0.9F;
  EXPECT_GT(seen_in(frame_.cloud).person_score, kSure);
  const auto seen = DepthPose(DepthPoseParams{}).look(wall(), head_before_middle(), kDown);
  ASSERT_TRUE(seen);
  EXPECT_LT(seen->person_score, 1.0F - kSure);
}

TEST_F(DepthsOfTheDemo, TellWhetherAPersonIsThereAsALookDoes) {
  const DepthPose network{DepthPoseParams{}};
  const RangeImage person = segment(colorless(frame_.cloud)).segments.at(0).range_image.value();
  constexpr float kSure = 4.0F;
  EXPECT_TRUE(network.shows_person(person, person_[Joint::kHead].position_m,
                                   frame_.cloud.stamp.gravity.down, kSure));
  // To the network something else in the mirror.
  RangeImage wall_on_the_left = wall();
  for (std::size_t i = 0; i < wall_on_the_left.depth_m.size(); ++i) {
    const auto width = static_cast<std::size_t>(wall_on_the_left.camera.width);
    if (i % width > width / 2) wall_on_the_left.labels[i] = PixelLabel::kOther;
  }
  const auto wall_is_over = [&](float odds) {
    return network.shows_person(wall_on_the_left, head_before_middle(), kDown, odds);
  };
  EXPECT_FALSE(wall_is_over(kSure));
  const float odds =
      log_odds(network.look(wall_on_the_left, head_before_middle(), kDown)->person_score);
  constexpr float kRounding = 0.01F;
  EXPECT_TRUE(wall_is_over(odds - kRounding)) << odds;
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

TEST_F(DepthsOfTheDemo, AreAskedBesideTheColors) {
  const auto poses = segment(frame_.cloud).segments.at(0).image_poses;
  ASSERT_EQ(poses.size(), static_cast<std::size_t>(kImageNetworkCount));
  for (const ImagePose& pose : poses) EXPECT_FALSE(pose.joints.empty());
}

}  // namespace
}  // namespace limbcast::segmenter
