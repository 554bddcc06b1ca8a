#include "modules/pose_fitter/refined/refined_fitter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "modules/pose_fitter/refined/evidence.hpp"
#include "modules/pose_fitter/refined/image_term.hpp"
#include "modules/pose_fitter/refined/solver.hpp"
#include "tests/pose_fitter/refined_body.hpp"

namespace limbcast::pose_fitter {
namespace {

using refined::BodyState;

constexpr double kDegree = M_PI / 180.0;
/// The body is the fitter's own, without noise: what is left are priors that pull to the mean [m].
constexpr float kJointToleranceM = 0.06F;

float error_m(const BodyPose& pose, Joint joint, const BodyState& body) {
  return (pose[joint].position_m - body.points[index(joint)].cast<float>()).norm();
}

float angle_deg(const Eigen::Vector3f& a, const Eigen::Vector3d& b) {
  return std::acos(std::min(1.0F, a.dot(b.normalized().cast<float>()))) /
         static_cast<float>(kDegree);
}

/// A body as a perfect network for poses would see it.
ImagePose in_image(const BodyState& body) {
  ImagePose pose{1.0F, {}};
  const float hips_z_m = static_cast<float>(body.points[index(Joint::kPelvis)].z());
  for (int joint = 0; joint < kJointCount; ++joint) {
    const Eigen::Vector3f place_m =
        refined::marked_place(body, joint, refined::ImageNetwork::kBlazePose).cast<float>();
    pose.joints.push_back({static_cast<Joint>(joint), testing::camera().project(place_m), 1.0F,
                           place_m.z() - hips_z_m});
  }
  return pose;
}

class RefinedFitterAtYaw : public ::testing::TestWithParam<int> {};

TEST_P(RefinedFitterAtYaw, FindsTheJointsOfAStandingBodyOnTheirSides) {
  const BodyState body = testing::standing_body(2.5, GetParam() * kDegree);

  const auto pose = RefinedFitter().fit(testing::seen(body), testing::stamp());

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

    const auto pose = RefinedFitter().fit(testing::seen(body), testing::stamp());

    ASSERT_TRUE(pose);
    ASSERT_EQ(pose->pointing.size(), 1U);
    EXPECT_EQ(pose->pointing[0].side, side == 0 ? Side::kLeft : Side::kRight);
    EXPECT_LT(angle_deg(pose->pointing[0].direction, direction), 4.0F);
    EXPECT_GT(pose->pointing[0].sigma_rad, 0.0F);
  }
}

TEST(RefinedFitter, ReportsNoPointingWhenArmsHang) {
  const auto pose =
      RefinedFitter().fit(testing::seen(testing::standing_body(2.5, 0.0)), testing::stamp());

  ASSERT_TRUE(pose);
  EXPECT_TRUE(pose->pointing.empty());
}

TEST(RefinedFitter, ReportsNoDirectionOfAnArmBehindABoard) {
  BodyState body = testing::standing_body(2.5, 0.0);
  testing::point_with(body, 0, {1.0, 0.0, -0.3});
  // The left shoulder stands 0.17 m to the image's right: the board begins there.
  const int board_u = 320 + static_cast<int>(520.0 * 0.17 / 2.5);

  const auto pose = RefinedFitter().fit(testing::seen(body, board_u), testing::stamp());

  ASSERT_TRUE(pose);
  for (const Pointing& pointing : pose->pointing) EXPECT_NE(pointing.side, Side::kLeft);
}

TEST(RefinedFitter, KeepsTheBodyOutOfFreeSpace) {
  BodyState body = testing::standing_body(2.5, 0.0);
  testing::point_with(body, 1, {-1.0, 0.0, -0.2});
  const Segment segment = testing::seen(body);

  const auto pose = RefinedFitter().fit(segment, testing::stamp());

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

/// The same person, seen by a camera with colours: none of it is skin.
Segment colored(Segment segment) {
  segment.range_image->is_skin.assign(segment.range_image->depth_m.size(), 0);
  return segment;
}

TEST(RefinedFitter, TurnsABodyToTheSensorWhereAFaceIsSeen) {
  Segment segment = colored(testing::seen(testing::standing_body(2.5, 180.0 * kDegree)));
  // Who faces the sensor has the left arm at the image's right.
  const auto left_m = [&] {
    const auto pose = RefinedFitter().fit(segment, testing::stamp());
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
    Segment segment = colored(testing::seen(testing::standing_body(2.5, 90.0 * kDegree)));
    segment.image_poses = {in_image(testing::standing_body(2.5, image_yaw_deg * kDegree))};
    RefinedParams params;
    // Surer than any network, so that it is told what the image shows, however well the shape fits.
    params.image_side_log_odds = 40.0;
    const auto pose = RefinedFitter(params).fit(segment, testing::stamp());
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
  const RefinedFitter fitter;

  const auto first = fitter.fit(segment, testing::stamp());
  const auto second = fitter.fit(segment, testing::stamp());

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

  const auto pose = RefinedFitter().fit(segment, stamp);

  ASSERT_TRUE(pose);
  const Eigen::Vector3f head = turned * body.points[refined::kHead].cast<float>();
  EXPECT_LT(((*pose)[Joint::kHead].position_m - head).norm(), kJointToleranceM);
}

TEST(RefinedFitter, FitsPointsWithoutARangeImage) {
  const BodyState body = testing::standing_body(2.5, 0.0);
  Segment segment = testing::seen(body);
  segment.range_image.reset();

  const auto pose = RefinedFitter().fit(segment, testing::stamp());

  ASSERT_TRUE(pose);
  EXPECT_LT(error_m(*pose, Joint::kHead, body), 0.1F);
  EXPECT_LT(error_m(*pose, Joint::kPelvis, body), 0.1F);
}

TEST(RefinedFitter, FindsNobodyInTooFewPoints) {
  Segment segment;
  EXPECT_FALSE(RefinedFitter().fit(segment, testing::stamp()));
  segment.seed_m = {0.0F, 0.0F, 2.0F};
  segment.points_m.assign(10, segment.seed_m);
  EXPECT_FALSE(RefinedFitter().fit(segment, testing::stamp()));
}

TEST(RefinedFitter, FindsNobodyInAWall) {
  Segment segment = testing::seen(testing::standing_body(2.5, 0.0));
  segment.range_image->depth_m.assign(segment.range_image->depth_m.size(), 2.5F);
  segment.range_image->labels.assign(segment.range_image->labels.size(), PixelLabel::kPerson);

  EXPECT_FALSE(RefinedFitter().fit(segment, testing::stamp()));
}

TEST(RefinedCost, RulesOutAnArmFarBehindTheTrunk) {
  const Segment segment = testing::seen(testing::standing_body(2.5, 0.0));
  const RefinedParams params;
  const auto observation = refined::observe(segment, testing::stamp(), params);
  ASSERT_TRUE(observation);
  // 20 degrees before and behind the trunk's plane, then 50.
  const auto cost_at = [&](double degrees_behind) {
    BodyState body = testing::standing_body(2.5, 0.0);
    testing::point_with(
        body, 0, {std::cos(degrees_behind * kDegree), 0.0, std::sin(degrees_behind * kDegree)});
    refined::NormalEquations equations;
    equations.clear(false);
    add_prior_terms(body, make_cones_of(body), *observation, refined::kAllParts, params, equations);
    return equations.cost;
  };

  // Where front and back look alike, noise and clothes decide by up to about 10 units of cost.
  EXPECT_LT(std::abs(cost_at(20.0) - cost_at(-20.0)), 5.0);
  EXPECT_GT(cost_at(50.0) - cost_at(-50.0), 10.0);
}

TEST(RefinedCost, MindsATrunkTurnedAgainstTheFace) {
  const Segment segment = testing::seen(testing::standing_body(2.5, 0.0));
  RefinedParams params;
  params.front_cost_per_log_odds = 4.0;
  auto observation = refined::observe(segment, testing::stamp(), params);
  ASSERT_TRUE(observation);
  const auto cost_at = [&](double yaw_deg) {
    return front_cost(testing::standing_body(2.5, yaw_deg * kDegree), *observation, params);
  };
  EXPECT_EQ(cost_at(0.0), 0.0);
  EXPECT_EQ(cost_at(180.0), 0.0);

  observation->face = {2.0F, 0.0F};
  EXPECT_NEAR(cost_at(0.0), 0.0, 1e-6);
  EXPECT_NEAR(cost_at(90.0), 4.0, 1e-6);
  EXPECT_NEAR(cost_at(180.0), 8.0, 1e-6);

  observation->face = {-2.0F, 0.0F};
  EXPECT_EQ(cost_at(0.0), 0.0);
  EXPECT_EQ(cost_at(180.0), 0.0);

  // Turned by 90 degrees from facing the camera, a body looks to the image's right.
  ASSERT_GT(testing::standing_body(2.5, 90.0 * kDegree).front().x(), 0.9);
  observation->face = {0.0F, 1.5F};
  EXPECT_NEAR(cost_at(90.0), 0.0, 1e-6);
  EXPECT_NEAR(cost_at(0.0), 3.0, 1e-6);
  EXPECT_NEAR(cost_at(-90.0), 6.0, 1e-6);
}

TEST(RefinedCost, MindsNoTrunkWhoseSurfaceAloneWasLookedAt) {
  const RefinedParams params;
  Segment segment = testing::seen(testing::standing_body(2.5, 0.0));
  segment.image_poses = {in_image(testing::standing_body(2.5, 90.0 * kDegree))};
  const auto observation = refined::observe(segment, testing::stamp(), params);
  EXPECT_EQ(front_cost(testing::standing_body(2.5, -90.0 * kDegree), *observation, params), 0.0);
}

TEST(RefinedCost, MindsATrunkTurnedAgainstTheImage) {
  const RefinedParams params;
  const double most = params.front_cost_per_log_odds * params.image_side_log_odds;
  const auto cost_at = [&](double yaw_deg, double image_yaw_deg) {
    Segment segment = colored(testing::seen(testing::standing_body(2.5, 0.0)));
    segment.image_poses = {in_image(testing::standing_body(2.5, image_yaw_deg * kDegree))};
    const auto observation = refined::observe(segment, testing::stamp(), params);
    return front_cost(testing::standing_body(2.5, yaw_deg * kDegree), *observation, params);
  };
  EXPECT_NEAR(cost_at(90.0, 90.0), 0.0, 0.01);
  EXPECT_NEAR(cost_at(0.0, 90.0), 0.5 * most, 0.01 * most);
  EXPECT_NEAR(cost_at(-90.0, 90.0), most, 0.01 * most);
  EXPECT_NEAR(cost_at(-135.0, 45.0), 0.5 * most, 0.01 * most);
  // The image term weighs left against right.
  EXPECT_NEAR(cost_at(180.0, 0.0), 0.0, 0.01 * most);
}

TEST(RefinedCost, MindsNoTrunkWhereTheImageTellsNoSides) {
  Segment segment = testing::seen(testing::standing_body(2.5, 0.0));
  segment.image_poses = {in_image(testing::standing_body(2.5, 90.0 * kDegree))};
  for (ImageJoint& joint : segment.image_poses.front().joints) joint.visibility = 0.0F;
  const RefinedParams params;
  const auto observation = refined::observe(segment, testing::stamp(), params);
  EXPECT_EQ(front_cost(testing::standing_body(2.5, -90.0 * kDegree), *observation, params), 0.0);
}

TEST(RefinedEvidence, CountsTheFaceAgainstABodyThatFacesTheOtherWay) {
  Segment segment = testing::seen(testing::standing_body(2.5, 0.0));
  segment.face.facing_log_odds = 3.0F;
  const RefinedParams params;
  const auto observation = refined::observe(segment, testing::stamp(), params);
  ASSERT_TRUE(observation);
  refined::PoseSearch search(*observation, params);

  const refined::Evidence evidence = gather_evidence(search.run(), search);

  // The shape alone is asked whether this is a person.
  EXPECT_GT(evidence.shape_flip_gap, 0.0);
  EXPECT_NEAR(evidence.flip_gap - evidence.shape_flip_gap, 3.0 * params.front_cost_per_log_odds,
              0.01);
}

TEST(RefinedCost, HoldsAGuessedHeadLessThanOneInSight) {
  Segment segment = testing::seen(testing::standing_body(2.5, 0.0));
  const RefinedParams params;
  const BodyState body = testing::standing_body(2.5, 0.0);
  BodyState aside = body;
  aside.points[refined::kHead].x() += 0.10;
  const auto cost_of_moving = [&] {
    const auto observation = refined::observe(segment, testing::stamp(), params);
    const auto cost_at = [&](const BodyState& at) {
      refined::NormalEquations equations;
      equations.clear(false);
      // The cones stay, so that only what is told of the head changes.
      add_prior_terms(at, make_cones_of(body), *observation, refined::kAllParts, params, equations);
      return equations.cost;
    };
    return cost_at(aside) - cost_at(body);
  };

  const double seen = cost_of_moving();
  segment.seed_kind = SeedKind::kBody;
  // 10 cm are two standard deviations of a head in sight.
  EXPECT_GT(seen, cost_of_moving() + 1.0);
}

TEST(RefinedCost, HasTheGradientOfItsDifferences) {
  BodyState body = testing::standing_body(2.5, 20.0 * kDegree);
  const Segment segment = testing::seen(body);
  const RefinedParams params;
  const auto observation = refined::observe(segment, testing::stamp(), params);
  ASSERT_TRUE(observation);
  // Off the minimum, so that the gradient is not zero.
  for (auto& point : body.points) point += Eigen::Vector3d(0.01, -0.008, 0.012);
  refined::Solver solver(*observation, params);
  // Priors only: the data term re-assigns points and rounds pixels on the way.
  const auto cost_at = [&](const BodyState& at) {
    refined::NormalEquations equations;
    equations.clear(true);
    add_prior_terms(at, make_cones_of(at), *observation, refined::kAllParts, params, equations);
    return equations;
  };
  const refined::NormalEquations here = cost_at(body);
  for (int unknown = 0; unknown < refined::kLogStature; ++unknown) {
    // The shoulders' mean follows the arm; the fitter holds it fixed within a step.
    const int point = unknown / 3;
    if (point >= refined::kShoulder && point < refined::kWrist) continue;
    constexpr double kStep = 1e-5;
    refined::Step step = refined::Step::Zero();
    step[unknown] = kStep;
    const double difference =
        (cost_at(moved(body, step)).cost - cost_at(moved(body, -step)).cost) / (2.0 * kStep);
    EXPECT_NEAR(here.gradient[unknown], difference, 0.02 * std::abs(difference) + 0.1) << unknown;
  }
}

/// The cost of what is known of bodies without looking, for a body before a level floor of unknown
/// height: each test changes what one term minds and nothing, or the same, for the others.
class PriorTerms : public ::testing::Test {
 protected:
  double cost_of(const BodyState& body) const {
    refined::NormalEquations equations;
    equations.clear(false);
    add_prior_terms(body, make_cones_of(body), *observation_, refined::kAllParts, RefinedParams{},
                    equations);
    return equations.cost;
  }
  /// Moves all points about the head.
  BodyState about_head(const Eigen::Matrix3d& change) const {
    BodyState body = body_;
    const Eigen::Vector3d head = body.points[refined::kHead];
    for (auto& point : body.points) point = head + change * (point - head);
    return body;
  }
  BodyState with_forearms_longer(double left_m, double right_m) const {
    BodyState body = body_;
    for (const int side : {0, 1}) {
      const Eigen::Vector3d way =
          (body.points[refined::kWrist + side] - body.points[refined::kElbow + side]).normalized();
      body.points[refined::kWrist + side] += (side == 0 ? left_m : right_m) * way;
    }
    return body;
  }

  const BodyState body_ = testing::standing_body(2.5, 0.0);
  std::optional<refined::Observation> observation_ = [this] {
    auto observation = refined::observe(testing::seen(body_), testing::stamp(), RefinedParams{});
    observation->floor_m.reset();
    return observation;
  }();
};

TEST_F(PriorTerms, MindABodyThatLeans) {
  const Eigen::AngleAxisd lean(20.0 * kDegree, Eigen::Vector3d::UnitZ());
  BodyState leaning = about_head(lean.toRotationMatrix());
  leaning.rotation = lean * leaning.rotation;
  EXPECT_GT(cost_of(leaning) - cost_of(body_), 3.0);
}

TEST_F(PriorTerms, MindAGiant) {
  BodyState giant = about_head(1.4 * Eigen::Matrix3d::Identity());
  giant.log_stature += std::log(1.4);
  EXPECT_GT(cost_of(giant) - cost_of(body_), 3.0);
}

TEST_F(PriorTerms, MindABodyThatIsNotAtItsHead) {
  BodyState moved_body = body_;
  for (auto& point : moved_body.points) point.x() += 0.1;
  EXPECT_GT(cost_of(moved_body) - cost_of(body_), 1.5);
}

TEST_F(PriorTerms, MindArmsOfUnequalLength) {
  EXPECT_GT(cost_of(with_forearms_longer(0.03, -0.03)) - cost_of(with_forearms_longer(0.03, 0.03)),
            30.0);
}

TEST_F(PriorTerms, MindAKneeBentBackwards) {
  const auto bent = [&](double ahead_m) {
    BodyState body = body_;
    body.points[refined::kKnee] += ahead_m * body.front();
    return body;
  };
  EXPECT_GT(cost_of(bent(-0.08)) - cost_of(bent(0.08)), 3.0);
}

TEST_F(PriorTerms, MindAPelvisBesideTheTrunk) {
  BodyState body = body_;
  body.points[refined::kPelvis].x() += 0.1;
  EXPECT_GT(cost_of(body) - cost_of(body_), 100.0);
}

TEST_F(PriorTerms, MindForearmsThatGoThroughEachOther) {
  // Both arms reach ahead and across; raised and lowered, they pass one over the other.
  const auto crossing = [&](double raised) {
    BodyState body = body_;
    testing::point_with(body, 0, {-0.45, raised, -1.0});
    testing::point_with(body, 1, {0.45, -raised, -1.0});
    return cost_of(body);
  };
  EXPECT_GT(crossing(0.0) - crossing(0.2), 4.0);
}

/// Marks what is seen of the person within a hand's length of `center_m` as skin-coloured.
void paint_skin(Segment& segment, const Eigen::Vector3d& center_m) {
  constexpr float kHandM = 0.08F;
  RangeImage& image = *segment.range_image;
  image.is_skin.assign(image.depth_m.size(), 0);
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      const std::size_t i = static_cast<std::size_t>(v) * image.camera.width + u;
      const Eigen::Vector3f point_m =
          image.camera.back_project(static_cast<float>(u), static_cast<float>(v), image.depth_m[i]);
      if ((point_m - center_m.cast<float>()).norm() < kHandM) image.is_skin[i] = 1;
    }
  }
}

class SkinTerm : public ::testing::Test {
 protected:
  static constexpr int kSide = 0;

  /// A body whose left arm points `degrees` below the horizontal.
  static BodyState pointing_down(double degrees) {
    BodyState body = testing::standing_body(2.5, 0.0);
    const double angle_rad = degrees * kDegree;
    testing::point_with(body, kSide, {std::cos(angle_rad), std::sin(angle_rad), -0.1});
    return body;
  }
  /// Of the pointing hand alone.
  refined::NormalEquations equations_at(const BodyState& body) const {
    const refined::Cones cones = make_cones_of(body);
    refined::Workspace workspace;
    workspace.cones.clear();
    refined::NormalEquations equations;
    equations.clear(true);
    add_skin_term(cones, *observation_, refined::arm_bit(kSide), workspace, equations);
    workspace.cones.add_to(body, equations);
    return equations;
  }

  const BodyState body_ = pointing_down(0.0);
  Segment segment_ = testing::seen(body_);
  std::optional<refined::Observation> observation_ =
      refined::observe(segment_, testing::stamp(), RefinedParams{});
};

TEST_F(SkinTerm, LeavesAHandWhereItIsWithoutColour) {
  EXPECT_EQ(equations_at(pointing_down(10.0)).cost, 0.0);
}

TEST_F(SkinTerm, PullsAHandToTheSkinAndLetsItGoFarFromAny) {
  paint_skin(segment_, body_.points[refined::kHand + kSide]);
  observation_ = refined::observe(segment_, testing::stamp(), RefinedParams{});
  ASSERT_TRUE(observation_);
  const BodyState beside = pointing_down(15.0);

  const refined::NormalEquations here = equations_at(beside);

  EXPECT_LT(equations_at(body_).cost, 0.1);
  EXPECT_GT(here.cost, 1.0);
  // 15 degrees have moved the hand by about 15 cm.
  const refined::Step uphill = here.gradient.normalized();
  EXPECT_LT(equations_at(moved(beside, -0.03 * uphill)).cost, here.cost);
  EXPECT_GT(equations_at(moved(beside, 0.03 * uphill)).cost, here.cost);
  // A sleeve or a glove is no worse than this, however far the next skin.
  EXPECT_LT(equations_at(pointing_down(80.0)).cost, 3.2);
  EXPECT_LT(equations_at(pointing_down(80.0)).gradient.norm(), 0.1 * here.gradient.norm());
}

TEST_F(SkinTerm, NeedsMoreThanStrayPixels) {
  constexpr int kEnough = 20;
  RangeImage& image = *segment_.range_image;
  image.is_skin.assign(image.depth_m.size(), 0);
  int painted = 0;
  for (std::size_t i = 0; painted < kEnough; ++i) {
    if (image.labels[i] != PixelLabel::kPerson) continue;
    image.is_skin[i] = 1;
    if (++painted < kEnough - 1) continue;
    observation_ = refined::observe(segment_, testing::stamp(), RefinedParams{});
    ASSERT_TRUE(observation_);
    EXPECT_EQ(equations_at(body_).cost > 0.0, painted == kEnough) << painted;
  }
}

}  // namespace
}  // namespace limbcast::pose_fitter
