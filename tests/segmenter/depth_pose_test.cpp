#include "modules/segmenter/depth_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
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

TEST_F(DepthsOfTheDemo, ShowAPersonAndDoNotShowOneInAWall) {
  constexpr float kSure = 0.9F;
  EXPECT_GT(seen_in(frame_.cloud).person_score, kSure);
  const auto seen = DepthPose(DepthPoseParams{}).look(wall(), head_before_middle(), kDown);
  ASSERT_TRUE(seen);
  EXPECT_LT(seen->person_score, 1.0F - kSure);
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
