#include "modules/pose_fitter/refined/confidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

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
    evidence_.head_odds = 3.0;
    evidence_.legs_share = 0.4;
    evidence_.sigma_m.fill(0.01);
    evidence_.in_sight.fill(true);
    evidence_.arms.fill({/*support=*/15.0, /*gap=*/3.0, /*bend_rad=*/0.1, /*sigma_rad=*/0.03});
  }
  Real of_direction() const { return direction_confidence(body_, evidence_.arms[0], evidence_); }

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

TEST_F(Confidence, OfADirectionTakesTheSameGapForMoreWithAChild) {
  const Real before = of_direction();
  body_.log_stature = std::log(0.7);  // 1.2 m
  EXPECT_GT(of_direction(), before);
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

TEST_F(Confidence, OfAPersonFallsWithADoubtfulHeadAndAnOddPosture) {
  const Real before = person_confidence(evidence_);
  evidence_.head_odds = -2.0;
  const Real doubtful_head = person_confidence(evidence_);
  EXPECT_LT(doubtful_head, before);
  evidence_.prior_cost = 30.0;
  EXPECT_LT(person_confidence(evidence_), doubtful_head);
}

}  // namespace
}  // namespace limbcast::pose_fitter::refined
