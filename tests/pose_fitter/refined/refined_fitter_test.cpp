#include "modules/pose_fitter/refined/refined_fitter.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <optional>

#include "common/angle.hpp"
#include "common/human_model/human_model.hpp"
#include "modules/pose_fitter/refined/confidence/evidence.hpp"
#include "modules/pose_fitter/refined/links_and_angles.hpp"
#include "modules/pose_fitter/refined/search/pose_search.hpp"
#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter {
namespace {

using refined::BodyState;
using testing::kDegree;

/// The body is the fitter's own, without noise: what is left are priors that pull to the mean [m].
constexpr float kJointToleranceM = 0.06F;

float error_m(const BodyPose& pose, Joint joint, const BodyState& body) {
  return (pose[joint].position_m - body.points[index(joint)].cast<float>()).norm();
}

std::optional<BodyPose> fit(const Segment& segment, const Stamp& stamp = testing::stamp(),
                            const RefinedParams& params = {}) {
  const auto candidate = RefinedFitter(params).fit(segment, stamp);
  return candidate ? std::optional(candidate->pose) : std::nullopt;
}

class RefinedFitterAtYaw : public ::testing::TestWithParam<int> {};

TEST_P(RefinedFitterAtYaw, FindsTheJointsOfAStandingBodyOnTheirSides) {
  const BodyState body = testing::standing_body(2.5, GetParam() * kDegree);

  const auto pose = fit(testing::seen(body));

  ASSERT_TRUE(pose);
  for (const Joint joint :
       {Joint::kHead, Joint::kNeck, Joint::kChest, Joint::kPelvis, Joint::kShoulderLeft,
        Joint::kShoulderRight, Joint::kKneeLeft, Joint::kKneeRight}) {
    EXPECT_TRUE((*pose)[joint].valid);
    EXPECT_LT(error_m(*pose, joint, body), kJointToleranceM) << kJointNames[index(joint)];
  }
}

INSTANTIATE_TEST_SUITE_P(AllAround, RefinedFitterAtYaw, ::testing::Values(0, 40, -40, 150));

TEST(RefinedFitter, TellsWhereAndWithWhichArmAPersonPoints) {
  for (const int side : {0, 1}) {
    BodyState body = testing::standing_body(2.5, 10.0 * kDegree);
    const Eigen::Vector3d direction =
        Eigen::Vector3d(side == 0 ? 1.0 : -1.0, -0.1, -0.6).normalized();
    testing::point_with(body, side, direction);

    const auto pose = fit(testing::seen(body));

    ASSERT_TRUE(pose);
    ASSERT_EQ(pose->pointing.size(), 1U);
    EXPECT_EQ(pose->pointing[0].side, side == 0 ? Side::kLeft : Side::kRight);
    EXPECT_LT(angle_deg(pose->pointing[0].direction, direction.cast<float>()), 4.0);
    EXPECT_GT(pose->pointing[0].sigma_rad, 0.0F);
  }
}

/// Angle of the model's degree of freedom of that name [degrees].
double angle_of_deg(const BodyPose& pose, const std::string& name) {
  const HumanModel model = load_human_model();
  for (int i = 0; i < kDegreesOfFreedom; ++i)
    if (model.degrees_of_freedom[i].name == name) return pose.angles_rad[i] / kDegree;
  ADD_FAILURE() << name;
  return 0.0;
}

TEST(RefinedFitter, TellsLengthsAndAnglesOfLinks) {
  BodyState body = testing::standing_body(2.5, 20.0 * kDegree);
  // Straight ahead of the body, level.
  testing::point_with(body, 0, body.front());

  const auto pose = fit(testing::seen(body));

  ASSERT_TRUE(pose);
  const auto length_m = [&](Joint from, Joint to) {
    return (body.points[index(to)] - body.points[index(from)]).norm();
  };
  EXPECT_NEAR(pose->link_lengths_m[index(Joint::kKneeRight)],
              length_m(Joint::kHipRight, Joint::kKneeRight), 0.05);
  EXPECT_NEAR(pose->link_lengths_m[index(Joint::kElbowLeft)],
              length_m(Joint::kShoulderLeft, Joint::kElbowLeft), 0.05);
  EXPECT_EQ(pose->link_lengths_m[index(Joint::kHead)], 0.0F);
  EXPECT_NEAR(angle_of_deg(*pose, "shoulder_left_flexion"), 90.0, 12.0);
  EXPECT_NEAR(angle_of_deg(*pose, "shoulder_right_flexion"), 0.0, 15.0);
  EXPECT_NEAR(angle_of_deg(*pose, "elbow_left_flexion"), 0.0, 20.0);
  EXPECT_NEAR(angle_of_deg(*pose, "hip_left_flexion"), 0.0, 12.0);
}

TEST(RefinedFitter, TellsNoAngleAndNoLengthOfALinkThatIsLeftOut) {
  BodyPose pose;
  const HumanModel model = load_human_model();
  refined::add_links_and_angles(model, {0.0F, 0.0F, -1.0F}, {0.0F, 1.0F, 0.0F}, pose);
  for (const float angle : pose.angles_rad) EXPECT_TRUE(std::isnan(angle));
  for (const float length_m : pose.link_lengths_m) EXPECT_EQ(length_m, 0.0F);
}

TEST(RefinedFitter, ReportsNoPointingWhenArmsHang) {
  const auto pose = fit(testing::seen(testing::standing_body(2.5, 0.0)));

  ASSERT_TRUE(pose);
  EXPECT_TRUE(pose->pointing.empty());
}

TEST(RefinedFitter, ReportsNoDirectionOfAnArmBehindABoard) {
  BodyState body = testing::standing_body(2.5, 0.0);
  testing::point_with(body, 0, {1.0, 0.0, -0.3});
  // The left shoulder stands 0.17 m to the image's right: the board begins there.
  const int board_u = 320 + static_cast<int>(520.0 * 0.17 / 2.5);

  const auto pose = fit(testing::seen(body, board_u));

  ASSERT_TRUE(pose);
  for (const Pointing& pointing : pose->pointing) EXPECT_NE(pointing.side, Side::kLeft);
}

TEST(RefinedFitter, KeepsTheBodyOutOfFreeSpace) {
  BodyState body = testing::standing_body(2.5, 0.0);
  testing::point_with(body, 1, {-1.0, 0.0, -0.2});
  const Segment segment = testing::seen(body);

  const auto pose = fit(segment);

  ASSERT_TRUE(pose);
  const RangeImage& image = *segment.range_image;
  for (const JointEstimate& joint : pose->joints) {
    if (!joint.valid) continue;
    const Eigen::Vector2f pixel = image.camera.project(joint.position_m);
    const auto u = static_cast<std::size_t>(std::lround(pixel.x()));
    const auto v = static_cast<std::size_t>(std::lround(pixel.y()));
    EXPECT_EQ(image.labels[v * image.camera.width + u], PixelLabel::kPerson);
  }
}

TEST(RefinedFitter, TurnsABodyToTheSensorWhereAFaceIsSeen) {
  Segment segment = testing::colored(testing::seen(testing::standing_body(2.5, 180.0 * kDegree)));
  // Who faces the sensor has the left arm at the image's right.
  const auto left_m = [&] {
    const auto pose = fit(segment);
    EXPECT_TRUE(pose);
    return (*pose)[Joint::kShoulderLeft].position_m.x() -
           (*pose)[Joint::kShoulderRight].position_m.x();
  };
  EXPECT_LT(left_m(), -0.2F);

  // Surer than any face, so that it is told what the face tells, however well the shape fits.
  segment.face.facing_log_odds = 40.0F;
  EXPECT_GT(left_m(), 0.2F);
}

TEST(RefinedFitter, TurnsABodyToTheSideThatTheImageShows) {
  const auto left_behind_m = [](double image_yaw_deg) {
    Segment segment = testing::colored(testing::seen(testing::standing_body(2.5, 90.0 * kDegree)));
    segment.image_poses = {testing::in_image(testing::standing_body(2.5, image_yaw_deg * kDegree))};
    RefinedParams params;
    // Surer than any network, so that it is told what the image shows, however well the shape fits.
    params.image_side_log_odds = 40.0;
    const auto pose = fit(segment, testing::stamp(), params);
    EXPECT_TRUE(pose);
    // Who looks to the image's right has the left shoulder farther away.
    return (*pose)[Joint::kShoulderLeft].position_m.z() -
           (*pose)[Joint::kShoulderRight].position_m.z();
  };
  EXPECT_GT(left_behind_m(90.0), 0.2F);
  EXPECT_LT(left_behind_m(-90.0), -0.2F);
}

TEST(RefinedFitter, GivesTheSamePoseEveryTime) {
  BodyState body = testing::standing_body(3.0, 30.0 * kDegree);
  testing::point_with(body, 0, {1.0, -0.2, -0.5});
  const Segment segment = testing::seen(body);

  const auto first = fit(segment);
  const auto second = fit(segment);

  ASSERT_TRUE(first && second);
  for (int i = 0; i < kJointCount; ++i) {
    EXPECT_EQ(first->joints[i].position_m, second->joints[i].position_m);
    EXPECT_EQ(first->joints[i].confidence, second->joints[i].confidence);
  }
}

TEST(RefinedFitter, AnswersInTheStampsFrameWhenTheImageIsTurned) {
  BodyState body = testing::standing_body(2.5, 0.0);
  Segment segment = testing::seen(body);
  // The same view as if the sensor's frame had x forward, y left, z up.
  Eigen::Matrix3f turned;
  turned << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  segment.range_image->frame_from_image = turned;
  segment.seed_m = turned * segment.seed_m;
  Stamp stamp = testing::stamp();
  stamp.gravity.down = turned * stamp.gravity.down;

  const auto pose = fit(segment, stamp);

  ASSERT_TRUE(pose);
  const Eigen::Vector3f head = turned * body.points[refined::kHead].cast<float>();
  EXPECT_LT(((*pose)[Joint::kHead].position_m - head).norm(), kJointToleranceM);
}

TEST(RefinedFitter, FitsPointsWithoutARangeImage) {
  const BodyState body = testing::standing_body(2.5, 0.0);
  Segment segment = testing::seen(body);
  segment.range_image.reset();

  const auto pose = fit(segment);

  ASSERT_TRUE(pose);
  EXPECT_LT(error_m(*pose, Joint::kHead, body), 0.1F);
  EXPECT_LT(error_m(*pose, Joint::kPelvis, body), 0.1F);
}

TEST(RefinedFitter, FindsNobodyInTooFewPoints) {
  Segment segment;
  EXPECT_FALSE(fit(segment));
  segment.seed_m = {0.0F, 0.0F, 2.0F};
  segment.points_m.assign(10, segment.seed_m);
  EXPECT_FALSE(fit(segment));
}

TEST(RefinedFitter, FindsNobodyInAWall) {
  Segment segment = testing::seen(testing::standing_body(2.5, 0.0));
  segment.range_image->depth_m.assign(segment.range_image->depth_m.size(), 2.5F);
  segment.range_image->labels.assign(segment.range_image->labels.size(), PixelLabel::kPerson);

  EXPECT_FALSE(fit(segment));
}

TEST(PoseSearch, FindsTheSameBodiesOnAnyNumberOfThreads) {
  constexpr int kMostThreads = 4;
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, kMostThreads);
  BodyState body = testing::standing_body(2.5, 30.0 * kDegree);
  testing::point_with(body, 1, Eigen::Vector3d(-0.8, 0.1, -0.6).normalized());
  const RefinedParams params;
  const auto observation = refined::observe(testing::seen(body), testing::stamp(), params);
  ASSERT_TRUE(observation);
  const auto search_on = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return refined::PoseSearch(*observation, params).run(); });
  };
  const auto expected = search_on(1);
  for (const int threads : {2, kMostThreads}) {
    const auto found = search_on(threads);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].cost, expected[i].cost);
      EXPECT_EQ(found[i].body.points, expected[i].body.points);
    }
  }
}

TEST(RefinedEvidence, CountsTheFaceAgainstABodyThatFacesTheOtherWay) {
  Segment segment = testing::seen(testing::standing_body(2.5, 0.0));
  segment.face.facing_log_odds = 3.0F;
  const RefinedParams params;
  const auto observation = refined::observe(segment, testing::stamp(), params);
  ASSERT_TRUE(observation);
  refined::PoseSearch search(*observation, params);

  const auto candidates = search.run();
  const refined::Evidence evidence = gather_evidence(candidates, search.moves());

  // The shape alone is asked whether this is a person.
  EXPECT_GT(evidence.shape_flip_gap, 0.0);
  EXPECT_NEAR(evidence.flip_gap - evidence.shape_flip_gap, 3.0 * params.front_cost_per_log_odds,
              0.01);
}

}  // namespace
}  // namespace limbcast::pose_fitter
