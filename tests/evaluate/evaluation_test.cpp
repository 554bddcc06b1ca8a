#include "modules/evaluate/evaluation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/evaluate/figure.hpp"

namespace limbcast::evaluate {
namespace {

Tally tally_of(std::vector<BodyPose> truth, std::vector<BodyPose> reported) {
  return evaluate({{frame(std::move(truth)), {}}}, {frame(std::move(reported))});
}

void hide(BodyPose& person, Joint joint) { person[joint].confidence = 0.0F; }

TEST(Evaluate, FindsNoFaultInTheTruth) {
  const Tally tally = tally_of({pointing_figure()}, {pointing_figure()});
  EXPECT_EQ(tally.frames, 1);
  EXPECT_EQ(tally.found.count, 1);
  EXPECT_EQ(tally.pointing_right.count, 1);
  EXPECT_EQ(tally.pointing_right.total, 1);
  EXPECT_EQ(tally.wrong_reported(), 0);
  EXPECT_EQ(tally.reported, 1);
  for (const Share& joint : tally.within_limit) EXPECT_EQ(joint.count, 1);
  ASSERT_EQ(tally.pointing_errors_deg.size(), 1U);
  EXPECT_NEAR(tally.pointing_errors_deg[0], 0.0, 1e-4);
  EXPECT_TRUE(tally.findings.empty());
}

TEST(Evaluate, KeepsSensorsApartThatTakeDataAtTheSameTime) {
  BodyPoses front = frame({pointing_figure()}), rear = frame({});
  front.stamp.sensor = "front";
  rear.stamp.sensor = "rear";
  const Tally tally = evaluate({{front, {}}, {rear, {}}}, {front, rear});
  EXPECT_EQ(tally.found.count, 1);
  EXPECT_EQ(tally.invented, 0);
  EXPECT_EQ(tally.frames_not_reported, 0);
}

TEST(Evaluate, CountsADirectionWithinFifteenDegreesAsRight) {
  EXPECT_EQ(tally_of({pointing_figure()}, {pointing_figure(14.9F)}).pointing_right.count, 1);
  const Tally inexact = tally_of({pointing_figure()}, {pointing_figure(15.1F)});
  EXPECT_EQ(inexact.pointing_right.count, 0);
  EXPECT_EQ(inexact.pointing_right.total, 1);
  EXPECT_EQ(inexact.wrong_direction, 0);
  EXPECT_NEAR(inexact.pointing_errors_deg.at(0), 15.1, 1e-4);
}

TEST(Evaluate, CountsADirectionBeyondTwentyDegreesAsWrong) {
  EXPECT_EQ(tally_of({pointing_figure()}, {pointing_figure(19.9F)}).wrong_direction, 0);
  const Tally tally = tally_of({pointing_figure()}, {pointing_figure(20.1F)});
  EXPECT_EQ(tally.wrong_direction, 1);
  EXPECT_EQ(tally.wrong_reported(), 1);
  EXPECT_EQ(tally.findings.at(0).what, "direction off");
}

TEST(Evaluate, CountsTheOtherArmAsWrongWhateverItsDirection) {
  BodyPose reported = pointing_figure();
  reported.pointing[0].side = Side::kRight;
  const Tally tally = tally_of({pointing_figure()}, {reported});
  EXPECT_EQ(tally.wrong_side, 1);
  EXPECT_EQ(tally.wrong_direction, 0);
  EXPECT_EQ(tally.pointing_right.count, 0);
  EXPECT_TRUE(tally.pointing_errors_deg.empty());
}

TEST(Evaluate, JudgesTheMostCertainArm) {
  BodyPose reported = pointing_figure();
  Pointing other = left_arm(90.0F);
  other.side = Side::kRight;
  reported.pointing.push_back(other);
  EXPECT_EQ(tally_of({pointing_figure()}, {reported}).wrong_reported(), 0);
}

TEST(Evaluate, CountsSilenceAsNotRightButNotAsWrong) {
  const Tally tally = tally_of({pointing_figure()}, {standing_figure()});
  EXPECT_EQ(tally.pointing_right.count, 0);
  EXPECT_EQ(tally.pointing_right.total, 1);
  EXPECT_EQ(tally.wrong_reported(), 0);
}

TEST(Evaluate, AsksNoDirectionOfAHiddenArmButMindsAWrongOne) {
  BodyPose truth = pointing_figure();
  truth.pointing[0].confidence = 0.0F;
  hide(truth, Joint::kWristLeft);
  EXPECT_EQ(tally_of({truth}, {standing_figure()}).pointing_right.total, 0);
  const Tally right = tally_of({truth}, {pointing_figure()});
  EXPECT_EQ(right.pointing_right.total, 0);
  EXPECT_EQ(right.wrong_reported(), 0);
  EXPECT_TRUE(right.pointing_errors_deg.empty());
  EXPECT_EQ(tally_of({truth}, {pointing_figure(30.0F)}).wrong_direction, 1);
}

TEST(Evaluate, LeavesOutLabelsThatCannotBeTrusted) {
  BodyPose truth = pointing_figure();
  truth.pointing[0].confidence = 0.0F;  // while elbow and wrist are visible
  const Tally tally = tally_of({truth}, {pointing_figure(40.0F)});
  EXPECT_EQ(tally.pointing_right.total, 0);
  EXPECT_EQ(tally.pointing_reported, 0);
  EXPECT_EQ(tally.wrong_reported(), 0);
}

TEST(Evaluate, MeasuresForearmAndHeadHandWhereTheTruthKnowsThem) {
  BodyPose truth = pointing_figure();
  truth.pointing[0].head_hand.setZero();
  BodyPose reported = pointing_figure();
  reported.pointing[0].forearm = left_arm(7.0F).direction;
  const Tally tally = tally_of({truth}, {reported});
  ASSERT_EQ(tally.forearm_errors_deg.size(), 1U);
  EXPECT_NEAR(tally.forearm_errors_deg[0], 7.0, 1e-4);
  EXPECT_TRUE(tally.head_hand_errors_deg.empty());
}

TEST(Evaluate, CountsPeopleInventedAndReportedTwice) {
  const Tally tally = tally_of({standing_figure()},
                               {standing_figure(), standing_figure(0.3F), standing_figure(2.0F)});
  EXPECT_EQ(tally.twice, 1);
  EXPECT_EQ(tally.invented, 1);
  EXPECT_EQ(tally.wrong_reported(), 2);
  EXPECT_EQ(tally.reported, 3);
  EXPECT_EQ(tally.invented_in_empty_frames, 0);
}

TEST(Evaluate, TellsWhatWasInventedAndTwice) {
  const Tally tally = tally_of({standing_figure()},
                               {standing_figure(), standing_figure(0.1F), standing_figure(2.0F)});
  ASSERT_EQ(tally.findings.size(), 2U);
  EXPECT_EQ(tally.findings[0].what, "reported twice");
  EXPECT_EQ(tally.findings[0].report, 1);
  EXPECT_EQ(tally.findings[1].what, "invented");
  EXPECT_EQ(tally.findings[1].report, 2);
  EXPECT_EQ(tally.findings[1].truth, -1);
}

TEST(Evaluate, CountsPosesInFramesWithoutPeople) {
  const Tally tally = tally_of({}, {standing_figure()});
  EXPECT_EQ(tally.empty_frames, 1);
  EXPECT_EQ(tally.invented_in_empty_frames, 1);
}

TEST(Evaluate, CountsJointsOfAMissedPersonAsOff) {
  const Tally tally = tally_of({standing_figure()}, {});
  EXPECT_EQ(tally.found.count, 0);
  EXPECT_EQ(tally.found.total, 1);
  for (const Share& joint : tally.within_limit) {
    EXPECT_EQ(joint.count, 0);
    EXPECT_EQ(joint.total, 1);
  }
  EXPECT_TRUE(tally.joint_errors_m[0].empty());
}

TEST(Evaluate, LooksAtVisibleJointsOnly) {
  BodyPose truth = standing_figure();
  hide(truth, Joint::kElbowLeft);
  BodyPose reported = standing_figure();
  reported[Joint::kElbowLeft].position_m.x() += 1.0F;
  reported[Joint::kWristLeft].position_m.x() += 0.11F;
  reported[Joint::kWristRight].position_m.x() += 0.09F;
  reported[Joint::kKneeLeft].valid = false;
  const Tally tally = tally_of({truth}, {reported});
  EXPECT_EQ(tally.within_limit[index(Joint::kElbowLeft)].total, 0);
  EXPECT_EQ(tally.within_limit[index(Joint::kWristLeft)].count, 0);
  EXPECT_EQ(tally.within_limit[index(Joint::kWristRight)].count, 1);
  EXPECT_EQ(tally.within_limit[index(Joint::kKneeLeft)].total, 1);
  EXPECT_EQ(tally.within_limit[index(Joint::kKneeLeft)].count, 0);
  EXPECT_NEAR(tally.joint_errors_m[index(Joint::kWristLeft)].at(0), 0.11, 1e-6);
  EXPECT_TRUE(tally.joint_errors_m[index(Joint::kKneeLeft)].empty());
}

TEST(Evaluate, NeedsNotFindPeopleWhoAreHardlyVisible) {
  BodyPose truth = standing_figure();
  for (int i = 2; i < kJointCount; ++i) truth.joints[i].confidence = 0.0F;
  EXPECT_EQ(tally_of({truth}, {}).found.total, 0);
  EXPECT_EQ(tally_of({truth}, {standing_figure()}).invented, 0);
}

TEST(Evaluate, MindsPointingOfRestingPeople) {
  const Tally silent = tally_of({resting_figure()}, {resting_figure()});
  EXPECT_EQ(silent.said_to_point.total, 1);
  EXPECT_EQ(silent.said_to_point.count, 0);
  BodyPose says = resting_figure();
  says.pointing.push_back(left_arm());
  EXPECT_EQ(tally_of({resting_figure()}, {says}).said_to_point.count, 1);
  EXPECT_EQ(tally_of({standing_figure()}, {says}).said_to_point.total,
            0);  // a straight, raised arm
}

TEST(Evaluate, AsksOfEachToldArmWhetherItIsThere) {
  BodyPose bent = standing_figure();  // points with no arm
  bent[Joint::kWristLeft].position_m =
      bent[Joint::kShoulderLeft].position_m + Eigen::Vector3f(0.0F, -0.1F, 0.0F);
  hide(bent, Joint::kWristLeft);
  BodyPose says = standing_figure();
  says.pointing.push_back(left_arm());
  const Tally off = tally_of({bent}, {says});
  EXPECT_EQ(off.told_arms_off.count, 1);
  EXPECT_EQ(off.told_arms_off.total, 1);
  EXPECT_EQ(off.findings.back().what, "arm is elsewhere than told");
  bent[Joint::kWristLeft].valid = false;  // nobody knows where it is
  EXPECT_EQ(tally_of({bent}, {says}).told_arms_off.total, 0);
}

TEST(Evaluate, AsksOfTheSecondToldArmTooWhetherItIsThere) {
  BodyPose says = pointing_figure();
  says.pointing.push_back(says.pointing[0]);
  says.pointing[1].side = Side::kRight;
  const Tally tally = tally_of({pointing_figure()}, {says});
  EXPECT_EQ(tally.told_arms_off.count, 1);
  EXPECT_EQ(tally.told_arms_off.total, 2);
  EXPECT_EQ(tally.pointing_right.count, 1);
}

TEST(SurelyNotPointing, HoldsForBentAndHangingArms) {
  EXPECT_TRUE(surely_not_pointing(resting_figure()));
  EXPECT_FALSE(surely_not_pointing(standing_figure()));
  BodyPose bent = standing_figure();
  bent[Joint::kWristLeft].position_m =
      bent[Joint::kElbowLeft].position_m + Eigen::Vector3f(0.1F, -0.2F, 0.0F);
  EXPECT_TRUE(surely_not_pointing(bent));  // atan(0.2 / 0.1) = 63 degrees
  bent[Joint::kWristLeft].position_m =
      bent[Joint::kElbowLeft].position_m + Eigen::Vector3f(0.15F, -0.2F, 0.0F);
  EXPECT_FALSE(surely_not_pointing(bent));  // 53 degrees
}

TEST(SurelyNotPointing, TakesTheHipsWhereALabelHasNoPelvis) {
  BodyPose truth = resting_figure();
  truth[Joint::kPelvis].valid = false;
  EXPECT_TRUE(surely_not_pointing(truth));
  truth[Joint::kHipLeft].valid = false;
  EXPECT_FALSE(surely_not_pointing(truth));
}

TEST(SurelyNotPointing, NeedsATrunkOrBentElbows) {
  BodyPose truth = resting_figure();
  truth[Joint::kPelvis].valid = false;
  truth[Joint::kHipRight].valid = false;
  EXPECT_FALSE(surely_not_pointing(truth));
  truth = resting_figure();
  truth[Joint::kNeck].valid = false;
  EXPECT_FALSE(surely_not_pointing(truth));
}

TEST(SurelyNotPointing, NeedsEveryJointOfTheArms) {
  for (const Joint joint : {Joint::kShoulderLeft, Joint::kElbowLeft, Joint::kWristRight}) {
    BodyPose truth = resting_figure();
    // What a joint that is not known is filled with must not count.
    truth[joint] = {};
    EXPECT_FALSE(surely_not_pointing(truth)) << kJointNames[index(joint)];
  }
}

TEST(SurelyNotPointing, NeedsBothArms) {
  BodyPose truth = resting_figure();
  truth[Joint::kWristLeft].valid = false;
  EXPECT_FALSE(surely_not_pointing(truth));
}

TEST(Evaluate, JoinsFramesByTimeAndCountsMissingOnes) {
  const std::vector<TruthFrame> truth = {{frame({standing_figure()}, 10), {}}, {frame({}, 20), {}}};
  const Tally tally =
      evaluate(truth, {frame({standing_figure()}, 10), frame({standing_figure()}, 99)});
  EXPECT_EQ(tally.frames, 2);
  EXPECT_EQ(tally.frames_not_reported, 1);
  EXPECT_EQ(tally.found.count, 1);
  EXPECT_EQ(tally.invented, 0);  // utime 99 has no truth
}

TEST(Evaluate, LeavesOutPersonsThatDoNotCount) {
  const TruthFrame truth{frame({standing_figure(), standing_figure(1.0F)}), {false, true}};
  const Tally tally = evaluate({truth}, {frame({standing_figure(), standing_figure(1.0F)})});
  EXPECT_EQ(tally.found.total, 1);
  EXPECT_EQ(tally.reported, 1);
  const TruthFrame nobody_counts{frame({standing_figure()}), {false}};
  EXPECT_EQ(evaluate({nobody_counts}, {frame({standing_figure(3.0F)})}).frames, 0);
}

TEST(Evaluate, KeepsWhatWasStatedBesideWhatWasMeasured) {
  BodyPose reported = pointing_figure(4.0F);
  reported.pointing[0].sigma_rad = 2.0F / 57.2957795F;
  reported.pointing[0].confidence = 0.8F;
  reported[Joint::kHead] = {true, reported[Joint::kHead].position_m + Eigen::Vector3f(0.2F, 0, 0),
                            0.6F, 0.05F, false};
  const Tally tally = tally_of({pointing_figure()}, {reported});
  ASSERT_EQ(tally.pointing_sigmas.size(), 1U);
  EXPECT_NEAR(tally.pointing_sigmas[0].stated, 2.0, 1e-4);
  EXPECT_NEAR(tally.pointing_sigmas[0].measured, 4.0, 1e-4);
  EXPECT_NEAR(tally.pointing_confidences.at(0).stated, 0.8, 1e-6);
  EXPECT_EQ(tally.pointing_confidences.at(0).measured, 1.0);
  ASSERT_EQ(tally.joint_sigmas.size(), 1U);
  EXPECT_NEAR(tally.joint_sigmas[0].measured, 0.2, 1e-6);
  EXPECT_EQ(tally.joint_confidences.at(0).measured, 0.0);
}

}  // namespace
}  // namespace limbcast::evaluate
