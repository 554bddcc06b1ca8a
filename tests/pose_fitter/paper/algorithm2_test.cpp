#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "modules/pose_fitter/paper/link_fitter.hpp"
#include "modules/pose_fitter/paper/rotation_fitter.hpp"
#include "modules/pose_fitter/paper/validity.hpp"

namespace limbcast::pose_fitter {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

const Vector3f kHead(0.0F, -0.6F, 3.0F);
const Vector3f kDown(0.0F, 1.0F, 0.0F);

/// Ends of the typical pose, facing the sensor, exactly.
FittedPose exact_pose(const HumanModel& model, int typical_pose) {
  const Matrix3f axes = body_axes(kHead, kDown, 0.0);
  FittedPose pose;
  pose.typical_pose = typical_pose;
  pose.links[0] = {true, kHead, 0.0F, 8.0F};
  for (int number = 1; number < kLinkCount; ++number) {
    const Link& link = model.links[number];
    pose.links[number] = {true,
                          pose.links[link.connected_to].end_m +
                              axes * model.typical_poses[typical_pose].directions[number] *
                                  static_cast<float>(link.length_m),
                          0.0F, 8.0F};
  }
  return pose;
}

bool hangs_on(const HumanModel& model, int number, int ancestor) {
  while (number != 0 && number != ancestor) number = model.links[number].connected_to;
  return number == ancestor;
}

/// A stick figure: points along the links that do not hang on `left_out`.
std::vector<Vector3f> stick_figure(const HumanModel& model, const FittedPose& pose, int left_out) {
  std::vector<Vector3f> points;
  for (int number = 1; number < kLinkCount; ++number) {
    if (left_out != 0 && hangs_on(model, number, left_out)) continue;
    const Vector3f from = pose.links[model.links[number].connected_to].end_m;
    const Vector3f line = pose.links[number].end_m - from;
    for (float t = 0.0F; t <= 1.0F; t += 0.02F) points.emplace_back(from + t * line);
  }
  return points;
}

class Algorithm2 : public testing::Test {
 protected:
  Algorithm2() { params_.near_radius_m = 0.06; }  // sticks have no thickness
  FittedPose fit(const std::vector<Vector3f>& points, int typical_pose) const {
    const Cluster cluster(points, kHead, {0.012, 0.0, 2.0, params_.dense_points});
    RotationFitter fitter(model_, params_, cluster, kHead, body_axes(kHead, kDown, 0.0));
    return fitter.fit(typical_pose);
  }
  HumanModel model_ = load_human_model();
  PaperFitterParams params_;
};

constexpr int kArmsSideways = 17;

TEST_F(Algorithm2, FitsAllLinksOfAWholeFigure) {
  const FittedPose truth = exact_pose(model_, kArmsSideways);
  const FittedPose found = fit(stick_figure(model_, truth, 0), kArmsSideways);
  for (int number = 1; number < kLinkCount; ++number) {
    ASSERT_TRUE(found.links[number].valid) << number;
    EXPECT_LT((found.links[number].end_m - truth.links[number].end_m).norm(), 0.06F) << number;
  }
  EXPECT_FLOAT_EQ(found.terms[1], 0.0F);
}

TEST_F(Algorithm2, LeavesOutEachMissingLinkAndAllThatHangsOnIt) {
  const FittedPose truth = exact_pose(model_, kArmsSideways);
  for (int missing = 1; missing < kLinkCount; ++missing) {
    const FittedPose found = fit(stick_figure(model_, truth, missing), kArmsSideways);
    for (int number = 1; number < kLinkCount; ++number) {
      EXPECT_EQ(found.links[number].valid, !hangs_on(model_, number, missing))
          << "link " << number << " without " << missing;
    }
  }
}

TEST_F(Algorithm2, PenalisesAMissingLinkMoreWhenOthersHangOnIt) {
  const FittedPose truth = exact_pose(model_, kArmsSideways);
  const FittedPose no_forearm = fit(stick_figure(model_, truth, 5), kArmsSideways);
  EXPECT_FLOAT_EQ(no_forearm.terms[1],
                  static_cast<float>(params_.alpha_missing * params_.missing_outer_penalty));
  const FittedPose no_arm = fit(stick_figure(model_, truth, 4), kArmsSideways);
  EXPECT_FLOAT_EQ(no_arm.terms[1],
                  static_cast<float>(params_.alpha_missing * (params_.missing_inner_penalty +
                                                              params_.missing_outer_penalty)));
}

TEST_F(Algorithm2, CountsThePointsThatAreNotNearThePose) {
  std::vector<Vector3f> points = stick_figure(model_, exact_pose(model_, kArmsSideways), 0);
  const FittedPose without = fit(points, kArmsSideways);
  EXPECT_FLOAT_EQ(without.terms[2], 0.0F);
  for (int i = 0; i < 100; ++i) points.emplace_back(1.2F, 0.5F + 0.013F * i, 3.0F);
  EXPECT_GT(fit(points, kArmsSideways).terms[2], 0.5F);
}

TEST_F(Algorithm2, PenalisesALinkAlongWhichPointsAreSparse) {
  constexpr int kForearm = 5;
  const FittedPose truth = exact_pose(model_, kArmsSideways);
  const FittedPose dense = fit(stick_figure(model_, truth, 0), kArmsSideways);
  EXPECT_FLOAT_EQ(dense.terms[3], 0.0F);
  std::vector<Vector3f> points = stick_figure(model_, truth, kForearm);
  const Vector3f elbow = truth.links[model_.links[kForearm].connected_to].end_m;
  const Vector3f forearm = truth.links[kForearm].end_m - elbow;
  for (float t = 0.0F; t <= 1.0F; t += 0.2F) points.emplace_back(elbow + t * forearm);
  const FittedPose sparse = fit(points, kArmsSideways);
  ASSERT_TRUE(sparse.links[kForearm].valid);
  EXPECT_FLOAT_EQ(sparse.terms[3], static_cast<float>(params_.alpha_density));
}

TEST_F(Algorithm2, ExpectsTheRightShoulderToMoveAsTheLeftOneDid) {
  constexpr float kTurnRad = 0.23F;
  FittedPose turned = exact_pose(model_, kArmsSideways);
  const Vector3f neck = turned.links[1].end_m;
  const Eigen::AngleAxisf turn(kTurnRad, Vector3f::UnitY());
  for (const int shoulder : {2, 3}) {
    turned.links[shoulder].end_m = neck + turn * (turned.links[shoulder].end_m - neck);
  }
  const FittedPose found = fit(stick_figure(model_, turned, 0), kArmsSideways);
  ASSERT_TRUE(found.links[2].valid && found.links[3].valid);
  EXPECT_GT(found.links[2].distance_m, 0.035F) << "the left one is off its reference";
  EXPECT_LT(found.links[3].distance_m, 0.03F) << "the right one's reference moved with it";
}

class FindBestFit : public testing::Test {
 protected:
  /// An upper arm that goes 25 cm along x, and points wherever a test puts them.
  LinkFit find(const std::vector<Vector3f>& points, const Vector3f& parent = Vector3f::Zero()) {
    const Cluster cluster(points, start_, {0.005, 0.0, 2.0, 8.0});
    return LinkFitter(cluster, params_)
        .find_best_fit(load_human_model().links[4], {start_, parent}, Vector3f::UnitX());
  }
  std::vector<Vector3f> line(const Vector3f& direction, float from_m, float to_m) const {
    std::vector<Vector3f> points;
    for (float t = from_m; t <= to_m; t += 0.01F) points.emplace_back(start_ + t * direction);
    return points;
  }
  Vector3f start_{0.0F, 0.0F, 3.0F};
  PaperFitterParams params_;
};

TEST_F(FindBestFit, EndsALineNearTheReferencePoint) {
  const LinkFit fit = find(line(Vector3f::UnitX(), 0.0F, 0.4F));
  ASSERT_TRUE(fit.valid);
  EXPECT_NEAR(fit.end_m.x(), 0.253F, 0.02F);
  EXPECT_NEAR(fit.distance_m, 0.0F, 0.02F);
}

TEST_F(FindBestFit, FindsNothingWithoutPointsNearTheReferencePoint) {
  EXPECT_FALSE(find(line(-Vector3f::UnitX(), 0.0F, 0.4F)).valid);
}

TEST_F(FindBestFit, KeepsTheLinksLength) {
  // 0.19 to 0.329 m are allowed.
  EXPECT_FALSE(find(line(Vector3f::UnitX(), 0.0F, 0.18F)).valid);
  EXPECT_TRUE(find(line(Vector3f::UnitX(), 0.0F, 0.22F)).valid);
}

TEST_F(FindBestFit, KeepsTheAngleToTheReference) {
  params_.max_link_turn_deg = 30.0;
  const auto turned = [&](float deg) {
    const float rad = deg * 3.14159265F / 180.0F;
    return line({std::cos(rad), std::sin(rad), 0.0F}, 0.0F, 0.3F);
  };
  EXPECT_TRUE(find(turned(25.0F)).valid);
  EXPECT_FALSE(find(turned(35.0F)).valid);
}

TEST_F(FindBestFit, KeepsTheAngleToThePreviousLink) {
  EXPECT_TRUE(find(line(Vector3f::UnitX(), 0.0F, 0.3F), Vector3f::UnitY()).valid);
  EXPECT_FALSE(find(line(Vector3f::UnitX(), 0.0F, 0.3F), -Vector3f::UnitX()).valid);
}

TEST_F(FindBestFit, NeedsPointsAllAlongTheLink) {
  std::vector<Vector3f> points = line(Vector3f::UnitX(), 0.0F, 0.02F);
  const std::vector<Vector3f> end = line(Vector3f::UnitX(), 0.24F, 0.26F);
  points.insert(points.end(), end.begin(), end.end());
  EXPECT_FALSE(find(points).valid);
}

TEST(Rotations, Are11StepsOf33Point3DegreesFromFacingTheSensor) {
  const HumanModel model = load_human_model();
  const Vector3f forward = body_axes(kHead, kDown, model.rotation_step_rad).transpose() *
                           body_axes(kHead, kDown, 0.0).col(2);
  EXPECT_NEAR(forward.z(), std::cos(33.3 * 3.14159265 / 180.0), 1e-5);
  EXPECT_NEAR(body_axes(kHead, kDown, 0.0).col(2).z(), -1.0F, 1e-5F);
  EXPECT_NEAR(body_axes(kHead, kDown, 0.0).col(1).y(), -1.0F, 1e-5F);
}

class Validity : public testing::Test {
 protected:
  bool valid(const FittedPose& pose) const {
    return is_valid(pose, model_, body_axes(kHead, kDown, 0.0), params_);
  }
  HumanModel model_ = load_human_model();
  PaperFitterParams params_;
};

TEST_F(Validity, AcceptsEveryTypicalPose) {
  for (int i = 0; i < kTypicalPoseCount; ++i) {
    EXPECT_TRUE(valid(exact_pose(model_, i))) << model_.typical_poses[i].name;
  }
}

TEST_F(Validity, RejectsALinkLongerThanTwoSigma) {
  for (const auto& [factor, expected] : {std::pair{1.2F, true}, {1.35F, false}}) {
    FittedPose pose = exact_pose(model_, 0);
    const Vector3f elbow = pose.links[4].end_m;
    pose.links[5].end_m = elbow + factor * (pose.links[5].end_m - elbow);
    EXPECT_EQ(valid(pose), expected) << factor;
  }
}

TEST_F(Validity, RejectsAnElbowThatIsFolded) {
  FittedPose pose = exact_pose(model_, 0);
  const Vector3f upper = pose.links[4].end_m - pose.links[2].end_m;
  pose.links[5].end_m = pose.links[4].end_m - upper;
  EXPECT_FALSE(valid(pose));
}

TEST_F(Validity, TakesTheMeanOrTheMedianOfScales) {
  const std::vector<float> scales = {1.0F, 1.0F, 1.6F};
  EXPECT_FLOAT_EQ(average_scale(scales, ScaleAverage::kMean), 1.2F);
  EXPECT_FLOAT_EQ(average_scale(scales, ScaleAverage::kMedian), 1.0F);
  EXPECT_FLOAT_EQ(average_scale({1.0F, 2.0F}, ScaleAverage::kMedian), 1.5F);
  EXPECT_FLOAT_EQ(average_scale({}, ScaleAverage::kMean), 0.0F);
}

TEST_F(Validity, MeasuresTwoSigmaByAFixedDeviationOrByThePosesOwn) {
  // 14 links of scale 1 and one of 1.1: deviation of their own 0.025, so the one is 3.7 of them
  // away.
  std::vector<float> scales(15, 1.0F);
  scales[3] = 1.1F;
  const float mean = average_scale(scales, ScaleAverage::kMean);
  EXPECT_TRUE(scales_agree(scales, mean, params_));
  params_.scale_deviation = ScaleDeviation::kPose;
  EXPECT_FALSE(scales_agree(scales, mean, params_));
}

TEST_F(Validity, DoesNotJudgeLinksThatWereLeftOut) {
  FittedPose pose = exact_pose(model_, 0);
  pose.links[5].valid = false;
  EXPECT_EQ(link_scales(pose, model_).size(), 14U);
  EXPECT_TRUE(valid(pose));
}

}  // namespace
}  // namespace limbcast::pose_fitter
