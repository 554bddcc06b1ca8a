#include "modules/pose_fitter/refined/confidence/confidence.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "modules/pose_fitter/refined/confidence/assessment.hpp"
#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// A body that fits well, its left arm straight; its neighbours cost a little more.
class Confidence : public ::testing::Test {
 protected:
  Confidence() {
    evidence_.flip_gap = evidence_.shape_flip_gap = 5.0;
    evidence_.weight = 200.0;
    evidence_.surface_cost = 30.0;
    evidence_.prior_cost = 3.0;
    evidence_.sigma_m.fill(0.01);
    evidence_.in_sight.fill(true);
    evidence_.arms.fill({/*support=*/15.0, /*gap=*/8.0, /*bend_rad=*/0.1, /*sigma_rad=*/0.03,
                         /*forwards=*/0.7, /*outwards=*/0.7});
  }
  Real of_direction() const { return direction_confidence(body_, 0, evidence_); }

  BodyState body_;
  Evidence evidence_;
};

TEST_F(Confidence, OfADirectionFallsWhereAnotherArmCostsLittleMore) {
  const Real before = of_direction();
  evidence_.arms[0].gap = 0.1;
  EXPECT_LT(of_direction(), before);
}

TEST_F(Confidence, OfADirectionFallsWhereTheArmExplainsLittle) {
  const Real before = of_direction();
  evidence_.arms[0].support = 1.0;
  EXPECT_LT(of_direction(), before);
}

TEST_F(Confidence, OfAJointFallsWhereTheImageShowsItElsewhere) {
  evidence_.images[0].told = true;
  evidence_.images[0].visibility.fill(1.0);
  const Real before = joint_confidence(evidence_, kWrist);
  evidence_.images[0].disagreement[kWrist] = 1.0;
  EXPECT_LT(joint_confidence(evidence_, kWrist), before);
}

TEST_F(Confidence, OfADirectionFallsWhereTheImageShowsTheHandElsewhere) {
  for (ImageEvidence& image : evidence_.images) image.visibility.fill(1.0);
  evidence_.images[0].told = true;
  const Real before = of_direction();
  evidence_.images[0].disagreement[kWrist] = 0.5;
  const Real of_one_network = of_direction();
  EXPECT_LT(of_one_network, before);
  evidence_.images[1].disagreement[kWrist] = 0.5;
  EXPECT_LT(of_direction(), of_one_network);
  evidence_.images[1].disagreement[kWrist + 1] = 1.0;  // of the other arm
  evidence_.images[1].disagreement[kWrist] = 0.0;
  EXPECT_EQ(of_direction(), of_one_network);
}

TEST_F(Confidence, OfADirectionRisesWhereTheDepthsShowThatTheArmPointsSo) {
  evidence_.arms[0].off_seen_axis_rad = M_PI / 2;
  const Real elsewhere = of_direction();
  evidence_.arms[0].off_seen_axis_rad = M_PI / 12;
  const Real near = of_direction();
  evidence_.arms[0].off_seen_axis_rad = 0.0;
  EXPECT_GT(near, elsewhere);
  EXPECT_GT(of_direction(), near);
}

TEST_F(Confidence, OfADirectionTakesTheSameGapForMoreWithAChild) {
  const Real before = of_direction();
  body_.log_stature = std::log(0.7);  // 1.2 m
  EXPECT_GT(of_direction(), before);
}

TEST_F(Confidence, OfADirectionFallsWhereTheArmIsBehindTheBodyOrAcrossIt) {
  const Real before = of_direction();
  evidence_.arms[0].forwards = -0.7;
  const Real behind = of_direction();
  EXPECT_LT(behind, before);
  evidence_.arms[0].forwards = 0.7;
  evidence_.arms[0].outwards = -0.7;
  EXPECT_LT(of_direction(), before);
}

TEST_F(Confidence, OfADirectionIsAlikeForTheSideAndTheFront) {
  evidence_.arms[0].outwards = 1.0;
  const Real wide = of_direction();
  evidence_.arms[0].outwards = 0.0;
  EXPECT_EQ(of_direction(), wide);
}

TEST_F(Confidence, OfTheFacingFallsWhereTheOtherWayCostsLittleMore) {
  const Real before = facing_confidence(evidence_);
  evidence_.flip_gap = 0.5;
  EXPECT_LT(facing_confidence(evidence_), before);
}

TEST_F(Confidence, OfTheFacingRisesWithAFaceThatAgreesAndFallsWithOneThatDoesNot) {
  evidence_.has_colors = evidence_.face_seen = true;
  const Real of_no_side = facing_confidence(evidence_);
  evidence_.face_agreement = 2.0;
  EXPECT_GT(facing_confidence(evidence_), of_no_side);
  evidence_.face_agreement = -2.0;
  EXPECT_LT(facing_confidence(evidence_), of_no_side);
}

TEST_F(Confidence, OfTheFacingFallsWhereTheImageTellsTheSidesOtherwise) {
  evidence_.has_colors = true;
  for (ImageEvidence& image : evidence_.images) image.sides_agreement = 1.0;
  const Real before = facing_confidence(evidence_);
  for (ImageEvidence& image : evidence_.images) image.sides_agreement = -1.0;
  EXPECT_LT(facing_confidence(evidence_), before);
}

TEST_F(Confidence, FallsWhereTheDepthsAloneTellOtherwiseAndNotBesideColors) {
  ImageEvidence& depths = evidence_.images[static_cast<std::size_t>(ImageNetwork::kDepthPose)];
  depths.told = true;
  depths.visibility.fill(1.0);
  for (const bool has_colors : {false, true}) {
    evidence_.has_colors = has_colors;
    const auto all = [&] {
      return std::array<Real, 3>{joint_confidence(evidence_, kWrist), facing_confidence(evidence_),
                                 of_direction()};
    };
    depths.sides_agreement = 1.0;
    depths.disagreement[kWrist] = 0.0;
    const std::array<Real, 3> agreed = all();
    depths.sides_agreement = -1.0;
    depths.disagreement[kWrist] = 1.0;
    const std::array<Real, 3> otherwise = all();
    for (std::size_t i = 0; i < agreed.size(); ++i) {
      if (has_colors)
        EXPECT_EQ(otherwise[i], agreed[i]) << i;
      else
        EXPECT_LT(otherwise[i], agreed[i]) << i;
    }
  }
}

TEST_F(Confidence, OfPairedJointsAloneFallsWhereTheBodyMayFaceTheOtherWay) {
  const Real shoulder = joint_confidence(evidence_, kShoulder),
             pelvis = joint_confidence(evidence_, kPelvis);
  evidence_.flip_gap = 0.0;
  EXPECT_LT(joint_confidence(evidence_, kShoulder), shoulder);
  EXPECT_EQ(joint_confidence(evidence_, kPelvis), pelvis);
}

TEST_F(Confidence, OfAWristFallsWithTheGapOfItsOwnArm) {
  const Real left = joint_confidence(evidence_, kWrist),
             right = joint_confidence(evidence_, kWrist + 1);
  evidence_.arms[1].gap = 0.1;
  EXPECT_EQ(joint_confidence(evidence_, kWrist), left);
  EXPECT_LT(joint_confidence(evidence_, kWrist + 1), right);
}

/// Both arms raised, the left one more.
class ToldDirections : public Confidence {
 protected:
  ToldDirections() {
    body_ = testing::standing_body(3.0, 0.0);
    testing::point_with(body_, 0, {0.7, -0.3, -0.7});
    testing::point_with(body_, 1, {-0.7, 0.1, -0.7});
    const auto observation = observe(testing::seen(body_), testing::stamp(), RefinedParams{});
    if (observation) observation_ = *observation;
    evidence_.head_odds = 3.0;
    evidence_.has_colors = true;
    for (ImageEvidence& image : evidence_.images) {
      image.told = true;
      image.person_score = image.sides_agreement = 1.0;
      image.visibility.fill(1.0);
    }
  }
  std::vector<Side> sides() const {
    std::vector<Side> sides;
    const auto told =
        assess({observation_, body_, 0.0, evidence_, gather_person_evidence(body_, observation_)});
    if (!told) return sides;
    for (const Pointing& pointing : told->pose.pointing) sides.push_back(pointing.side);
    return sides;
  }
  /// The image shows one arm's hand so far elsewhere that the arm's confidence lies between `least`
  /// and `most`.
  void make_as_sure(int side, Real least, Real most) {
    evidence_.arms[side] = {/*support=*/15.0,   /*gap=*/15.0,     /*bend_rad=*/0.1,
                            /*sigma_rad=*/0.03, /*forwards=*/0.0, /*outwards=*/1.0};
    for (Real disagreement = 0.0; disagreement < 5.0; disagreement += 0.01) {
      for (ImageEvidence& image : evidence_.images)
        image.disagreement[kWrist + side] = disagreement;
      const Real confidence = direction_confidence(body_, side, evidence_);
      if (confidence > least && confidence < most) return;
    }
    ADD_FAILURE() << "no arm is as sure as " << least << " to " << most;
  }

  Observation observation_;
};

TEST_F(ToldDirections, AreOfBothArmsWhereBothAreSure) {
  EXPECT_EQ(sides(), (std::vector<Side>{Side::kLeft, Side::kRight}));
}

TEST_F(ToldDirections, AreNoneOfAHardlySureArmBesideAnUnsureOneThatIsMoreRaised) {
  make_as_sure(0, 0.5, 0.7);
  make_as_sure(1, 0.85, 0.95);
  EXPECT_TRUE(sides().empty());
}

TEST_F(ToldDirections, AreOfTheSureArmBesideAnUnsureOneThatIsMoreRaised) {
  make_as_sure(0, 0.3, 0.5);
  make_as_sure(1, 0.995, 1.0);
  EXPECT_EQ(sides(), std::vector<Side>{Side::kRight});
}

TEST_F(ToldDirections, IncludeTheOtherArmWhereTheMoreRaisedOneIsSurelyWrong) {
  evidence_.arms[0] = {/*support=*/0.0,   /*gap=*/0.0,
                       /*bend_rad=*/0.1,  /*sigma_rad=*/0.5,
                       /*forwards=*/-0.7, /*outwards=*/-0.7};
  EXPECT_EQ(sides(), std::vector<Side>{Side::kRight});
}

TEST_F(ToldDirections, AreNoneOfABodyThatMayFaceTheOtherWay) {
  evidence_.flip_gap = 0.0;
  for (ImageEvidence& image : evidence_.images) image.sides_agreement = 0.0;
  // Without any evidence it faces as it was fitted, as 97 of 100 do; here a face tells otherwise.
  evidence_.face_seen = true;
  evidence_.face_agreement = -4.0;
  EXPECT_TRUE(sides().empty());
}

}  // namespace
}  // namespace limbcast::pose_fitter::refined
