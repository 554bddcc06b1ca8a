#include "modules/viewer/pictures.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/viewer/scene.hpp"

namespace limbcast::viewer {
namespace {

const cv::Vec3b kWall(90, 90, 90);

ViewFrame whole_frame() {
  ViewFrame frame;
  frame.cloud = wall();
  frame.poses = pointing_arm();
  frame.segments.emplace();
  return frame;
}

cv::Vec3b pixel(const cv::Mat& picture, int u, int v) { return picture.at<cv::Vec3b>(v, u); }

TEST(Pictures, DrawJointsAndLinksWhereTheCameraSeesThem) {
  const cv::Mat picture = draw_skeleton(whole_frame());
  ASSERT_EQ(picture.size(), cv::Size(160, 120));
  // 120 px * 1 m / 3 m = 40 px right of the principal point, and so on.
  for (const int u : {120, 100, 80}) EXPECT_GT(pixel(picture, u, 60)[0], 200) << u;
  // Between elbow and shoulder: the orange of right arms.
  EXPECT_GT(pixel(picture, 110, 60)[2], 200);
  EXPECT_LT(pixel(picture, 110, 60)[0], 100);
  EXPECT_EQ(pixel(picture, 100, 30), kWall);
}

TEST(Pictures, DrawTheRayBeyondTheHand) {
  const cv::Mat with_ray = draw_skeleton(whole_frame());
  // Green 1 m beyond the wrist: 40 px.
  EXPECT_GT(pixel(with_ray, 40, 60)[1], 200);
  ViewFrame frame = whole_frame();
  frame.poses->persons[0].pointing.clear();
  EXPECT_EQ(pixel(draw_skeleton(frame), 40, 60), kWall);
}

TEST(Pictures, DrawARingAsWideAsTheRayIsUncertain) {
  ViewFrame frame = whole_frame();
  // 2.5 m of ray, 0.2 rad: a radius of 0.51 m, seen from the sensor as an upright line at the end.
  const auto ring_px = [&frame](float sigma_rad) {
    frame.poses->persons[0].pointing[0].sigma_rad = sigma_rad;
    cv::Mat1b green;
    cv::inRange(draw_skeleton(frame), cv::Scalar(40, 150, 40), cv::Scalar(95, 255, 95), green);
    return cv::boundingRect(green).height;
  };
  EXPECT_LT(ring_px(0.0F), 15);
  // 120 px focal length, 3 m away: 2 x 0.51 m are 41 px.
  EXPECT_NEAR(ring_px(0.2F), 41, 4);
}

TEST(Pictures, LeaveOutJointsThatAreNotValid) {
  ViewFrame frame = whole_frame();
  frame.poses->persons[0].pointing.clear();
  frame.poses->persons[0][Joint::kWristRight].valid = false;
  const cv::Mat picture = draw_skeleton(frame);
  EXPECT_EQ(pixel(picture, 80, 60), kWall);
  EXPECT_GT(pixel(picture, 100, 60)[0], 200);
}

TEST(Pictures, ShowTheTruthBesideThePoses) {
  ViewFrame frame = whole_frame();
  frame.truth = pointing_arm();
  for (JointEstimate& joint : frame.truth->persons[0].joints) joint.position_m.y() = 0.75F;
  // 30 px lower.
  EXPECT_EQ(pixel(draw_skeleton(whole_frame()), 95, 90), kWall);
  EXPECT_GT(pixel(draw_skeleton(frame), 95, 90)[0], 200);
}

TEST(Pictures, ColorPointsOfASegmentInItsColor) {
  ViewFrame frame = whole_frame();
  Segment segment;
  segment.seed_m = {1.0F, 1.0F, 3.0F};
  segment.points_m.emplace_back(0.0F, 0.0F, 3.0F);
  frame.segments->segments.push_back(segment);
  const cv::Mat picture = draw_segments_in_colors(frame);
  EXPECT_GT(pixel(picture, 80, 60)[2], pixel(picture, 80, 60)[0]);
  EXPECT_EQ(pixel(picture, 40, 60)[2], pixel(picture, 40, 60)[0]);
}

TEST(Pictures, MarkPartsInSkinColor) {
  ViewFrame frame = whole_frame();
  Segment segment;
  RangeImage window;
  window.camera = {4, 4, 120.0, 120.0, 0.0, 0.0};
  window.origin_u = 20;
  window.origin_v = 30;
  window.is_skin.assign(16, 1);
  segment.range_image = window;
  segment.seed_m = {1.0F, 1.0F, 3.0F};
  frame.segments->segments.push_back(segment);
  const cv::Mat picture = draw_input(frame);
  EXPECT_NE(pixel(picture, 20, 30), kWall);
  EXPECT_EQ(pixel(picture, 19, 30), kWall);
}

TEST(Pictures, HolesAreBlackInTheDisparity) {
  ViewFrame frame = whole_frame();
  frame.cloud->points_m[60 * 160 + 100].setZero();
  const cv::Mat picture = draw_disparity(frame);
  EXPECT_EQ(pixel(picture, 100, 60), cv::Vec3b(0, 0, 0));
  EXPECT_NE(pixel(picture, 101, 60), cv::Vec3b(0, 0, 0));
}

/// Where the right arm is drawn: the box around its orange.
cv::Rect arm_from(const Orbit& orbit) {
  ViewFrame frame = whole_frame();
  frame.cloud.reset();
  frame.poses->persons[0].pointing.clear();
  cv::Mat1b orange;
  cv::inRange(draw_scene(frame, orbit), cv::Scalar(0, 90, 200), cv::Scalar(60, 140, 255), orange);
  return cv::boundingRect(orange);
}

TEST(Pictures, ShowTheSceneFromAnywhere) {
  // The arm is stretched out across the sensor's view: 1 m, of which some is under the joints.
  const int across_px = arm_from({}).width;
  EXPECT_GT(across_px, 100);
  // Turned by 60 degrees it looks half as long, by 90 it is one point, from behind all of it.
  EXPECT_NEAR(arm_from({60.0F, 0.0F}).width, 0.5 * across_px, 0.1 * across_px);
  EXPECT_LT(arm_from({90.0F, 0.0F}).width, 0.1 * across_px);
  EXPECT_NEAR(arm_from({180.0F, 0.0F}).width, across_px, 0.1 * across_px);
  // Above and below, it is still across.
  for (const float elevation_deg : {-90.0F, -45.0F, 45.0F, 90.0F})
    EXPECT_NEAR(arm_from({0.0F, elevation_deg}).width, across_px, 0.1 * across_px);
}

TEST(Pictures, ShowWhatIsNearerToTheEyeLarger) {
  const int once_px = arm_from({}).width;
  EXPECT_NEAR(arm_from({0.0F, 0.0F, 1.5F}).width, 1.5 * once_px, 0.1 * once_px);
  EXPECT_NEAR(arm_from({0.0F, 0.0F, 0.5F}).width, 0.5 * once_px, 0.1 * once_px);
}

TEST(Pictures, ShowTheRightSideOfTheImageNearerFromTheRight) {
  // The shoulder is at the image's right, the hand in its middle.
  const ViewFrame frame = whole_frame();
  const Viewpoint view = orbit_view(frame, {60.0F, 0.0F}, kPictureSize);
  const auto distance_m = [&](Joint joint) {
    return (view.eye_from_frame * frame.poses->persons[0][joint].position_m).z();
  };
  EXPECT_LT(distance_m(Joint::kShoulderRight), distance_m(Joint::kWristRight));
}

TEST(Pictures, AFrameWithNobodyShowsTheImage) {
  ViewFrame frame = whole_frame();
  frame.poses->persons.clear();
  EXPECT_EQ(
      cv::norm(draw_skeleton(frame), cv::Mat(120, 160, CV_8UC3, cv::Scalar::all(90)), cv::NORM_INF),
      0.0);
}

TEST(Pictures, ShowDepthInGreyWhereTheSensorSeesNoColours) {
  ViewFrame frame = whole_frame();
  frame.poses->persons.clear();
  frame.cloud->colors.clear();
  Cloud& cloud = *frame.cloud;
  cloud.points_m[60 * 160 + 100] *= 0.5F;
  cloud.points_m[60 * 160 + 101].setZero();
  const cv::Mat picture = draw_skeleton(frame);
  const cv::Vec3b far = pixel(picture, 99, 60), near = pixel(picture, 100, 60),
                  hole = pixel(picture, 101, 60);
  EXPECT_EQ(far, cv::Vec3b::all(far[0]));
  EXPECT_GT(near[0], far[0]);
  EXPECT_LT(hole[0], far[0]);
}

TEST(Pictures, WorkWhateverIsMissing) {
  for (int missing = 0; missing < 16; ++missing) {
    ViewFrame frame = whole_frame();
    frame.truth = pointing_arm();
    if (missing & 1) frame.cloud.reset();
    if (missing & 2) frame.segments.reset();
    if (missing & 4) frame.poses.reset();
    if (missing & 8) frame.truth.reset();
    const auto pictures = draw_pictures(frame, {});
    ASSERT_EQ(pictures.size(), 7U);
    for (const Picture& picture : pictures) EXPECT_FALSE(picture.image.empty()) << picture.name;
    EXPECT_FALSE(draw_sheet(frame, pictures).empty());
  }
}

TEST(Pictures, AnUnorganizedCloudIsSeenFromTheSensor) {
  ViewFrame frame = whole_frame();
  frame.cloud->camera.reset();
  frame.cloud->width *= frame.cloud->height;
  frame.cloud->height = 1;
  frame.cloud->colors.clear();
  EXPECT_EQ(draw_skeleton(frame).size(), kPictureSize);
  EXPECT_EQ(draw_pictures(frame, {}).size(), 7U);
}

}  // namespace
}  // namespace limbcast::viewer
