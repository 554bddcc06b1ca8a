#include "modules/pose_fitter/paper/paper_fitter.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <set>

#include "tests/pose_fitter/synthetic_figure.hpp"

namespace limbcast::pose_fitter {
namespace {

using Eigen::Vector3f;

/// End points lie on a sheet 5 cm behind the skin and are chosen within centimetres of it; a wrist
/// carries the error of three links.
constexpr float kJointToleranceM = 0.13F;
constexpr float kWristToleranceM = 0.19F;

/// A view in which both arms are seen: arms that reach forward are turned out of the line of sight.
double view_rotation_rad(const HumanModel& model, int pose) {
  static const std::set<std::string> kSideways = {
      "forward/hanging/standing", "hanging/forward/standing", "forward/forward/standing",
      "hanging/phone/standing",   "hanging/hanging/sitting",  "forward/forward/sitting"};
  const bool turned = kSideways.count(model.typical_poses[pose].name) > 0;
  return turned ? (model.rotation_count - 1) * model.rotation_step_rad : 0.0;
}

class TypicalPoses : public testing::TestWithParam<int> {};

TEST_P(TypicalPoses, AreRecoveredFromASyntheticFigure) {
  const PaperFitter fitter;
  FigureOptions options;
  options.rotation_rad = view_rotation_rad(fitter.model(), GetParam());
  const Figure figure = make_figure(fitter.model(), GetParam(), options);
  const auto body = fitter.fit(figure.segment, figure.stamp);
  ASSERT_TRUE(body.has_value());
  for (int j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<Joint>(j);
    const bool wrist = joint == Joint::kWristLeft || joint == Joint::kWristRight;
    EXPECT_TRUE((*body)[joint].valid) << kJointNames[j];
    EXPECT_LT(joint_error_m(*body, figure, joint), wrist ? kWristToleranceM : kJointToleranceM)
        << kJointNames[j] << " of " << fitter.model().typical_poses[GetParam()].name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, TypicalPoses, testing::Range(0, kTypicalPoseCount));

Figure standing_figure(const FigureOptions& options = {}) {
  return make_figure(load_human_model(), 1, options);
}

TEST(PaperFitter, TellsLengthsAnglesAndTheFourTermsOfEq1) {
  const Figure figure = standing_figure();
  const auto body = PaperFitter().fit(figure.segment, figure.stamp);
  ASSERT_TRUE(body.has_value());
  EXPECT_EQ(body->typical_pose, 1);
  EXPECT_FLOAT_EQ(body->rotation_deg, 0.0F);
  EXPECT_NEAR(body->scale, 1.0F, 0.12F);
  EXPECT_FLOAT_EQ(body->link_lengths_m[index(Joint::kHead)], 0.0F);
  EXPECT_NEAR(body->link_lengths_m[index(Joint::kKneeLeft)], 0.41F, 0.1F);
  float sum = 0.0F;
  for (const float term : body->error_terms) {
    EXPECT_GE(term, 0.0F);
    sum += term;
  }
  EXPECT_FLOAT_EQ(sum, body->error);
  for (const float angle : body->angles_rad) EXPECT_TRUE(std::isfinite(angle));
  ASSERT_FALSE(body->pointing.empty());
  EXPECT_EQ(body->pointing[0].side, Side::kLeft);
}

TEST(PaperFitter, TellsByEq2HowMuchTableIIsTooLong) {
  PaperFitterParams params;
  params.model_files.links = "table1";
  const Figure figure = standing_figure();
  const auto body = PaperFitter(params).fit(figure.segment, figure.stamp);
  ASSERT_TRUE(body.has_value());
  // The figure's links are 0.42 to 0.87 of those of Table I.
  EXPECT_GT(body->scale, 0.42F);
  EXPECT_LT(body->scale, 0.87F);
}

TEST(PaperFitter, PointsWithNoHiddenArmAndKeepsTheRest) {
  FigureOptions options;
  options.without[4] = options.without[5] = true;
  const Figure figure = standing_figure(options);
  const auto body = PaperFitter().fit(figure.segment, figure.stamp);
  ASSERT_TRUE(body.has_value());
  EXPECT_TRUE((*body)[Joint::kWristRight].valid);
  EXPECT_TRUE((*body)[Joint::kAnkleLeft].valid);
  for (const Pointing& pointing : body->pointing) EXPECT_NE(pointing.side, Side::kLeft);
}

TEST(PaperFitter, ReportsNobodyInCloudsWithoutAPerson) {
  const PaperFitter fitter;
  const Stamp stamp = standing_figure().stamp;
  Segment segment;
  segment.seed_m = {0.0F, -0.6F, 3.0F};
  EXPECT_FALSE(fitter.fit(segment, stamp));
  segment.points_m = {segment.seed_m};
  EXPECT_FALSE(fitter.fit(segment, stamp));
  segment.points_m.assign(5000, Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_FALSE(fitter.fit(segment, stamp));
  segment.points_m.assign(5000, Vector3f::Constant(std::numeric_limits<float>::infinity()));
  EXPECT_FALSE(fitter.fit(segment, stamp));
  segment.points_m.assign(5000, Vector3f::Zero());
  EXPECT_FALSE(fitter.fit(segment, stamp));
}

TEST(PaperFitter, IgnoresNanPointsAmongGoodOnes) {
  Figure figure = standing_figure();
  const PaperFitter fitter;
  const auto clean = fitter.fit(figure.segment, figure.stamp);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  figure.segment.points_m.insert(figure.segment.points_m.begin(), 50, Vector3f(0.0F, nan, 3.0F));
  const auto dirty = fitter.fit(figure.segment, figure.stamp);
  ASSERT_TRUE(clean && dirty);
  EXPECT_EQ(clean->error, dirty->error);
}

TEST(PaperFitter, ReportsNobodyWhenTheSeedIsNoPlace) {
  Figure figure = standing_figure();
  figure.segment.seed_m.x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(PaperFitter().fit(figure.segment, figure.stamp));
}

TEST(PaperFitter, ReportsNobodyWhenNoPoseIsValid) {
  PaperFitterParams params;
  params.scale_sigma = 1e-4;  // no fitted lengths agree so well
  const Figure figure = standing_figure();
  EXPECT_FALSE(PaperFitter(params).fit(figure.segment, figure.stamp));
}

TEST(PaperFitter, GivesTheSamePoseOnAnyNumberOfThreads) {
  const Figure figure = standing_figure();
  const PaperFitter fitter;
  const auto expected = fitter.fit(figure.segment, figure.stamp);
  ASSERT_TRUE(expected.has_value());
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto body = fitter.fit(figure.segment, figure.stamp);
    ASSERT_TRUE(body.has_value());
    EXPECT_EQ(body->error, expected->error);
    for (int j = 0; j < kJointCount; ++j) {
      EXPECT_EQ(body->joints[j].position_m, expected->joints[j].position_m);
    }
  }
}

}  // namespace
}  // namespace limbcast::pose_fitter
