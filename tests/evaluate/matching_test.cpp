#include "modules/evaluate/matching.hpp"

#include <gtest/gtest.h>

#include "tests/evaluate/figure.hpp"

namespace limbcast::evaluate {
namespace {

constexpr float kMaxDistance = 0.5F;

TEST(PersonDistance, IsTheMeanOfHeadAndTrunk) {
  BodyPose moved = standing_figure();
  moved[Joint::kHead].position_m.x() += 0.4F;
  moved[Joint::kWristLeft].position_m.x() += 5.0F;  // arms do not tell who it is
  EXPECT_NEAR(*person_distance_m(standing_figure(), moved), 0.1F, 1e-6F);
}

TEST(PersonDistance, FallsBackToAllJointsWhereTheTrunkIsUnknown) {
  BodyPose only_legs = standing_figure();
  for (const Joint joint : {Joint::kHead, Joint::kNeck, Joint::kChest, Joint::kPelvis})
    only_legs[joint].valid = false;
  move(only_legs, {0.0F, 0.2F, 0.0F});
  EXPECT_NEAR(*person_distance_m(standing_figure(), only_legs), 0.2F, 1e-6F);
}

TEST(PersonDistance, IsNothingWithoutACommonJoint) {
  EXPECT_FALSE(person_distance_m(standing_figure(), BodyPose{}));
}

TEST(MatchPersons, PairsTheNearest) {
  const auto matching =
      match_persons({standing_figure(0.0F), standing_figure(0.4F)},
                    {standing_figure(0.35F), standing_figure(0.1F)}, kMaxDistance);
  EXPECT_EQ(matching.report_of_truth[0], 1U);
  EXPECT_EQ(matching.report_of_truth[1], 0U);
}

TEST(MatchPersons, TellsTwiceFromInvented) {
  const auto matching = match_persons(
      {standing_figure()}, {standing_figure(0.2F), standing_figure(0.05F), standing_figure(0.6F)},
      kMaxDistance);
  EXPECT_EQ(matching.report_of_truth[0], 1U);
  EXPECT_EQ(matching.kinds[0], ReportKind::kTwice);
  EXPECT_EQ(matching.kinds[1], ReportKind::kMatched);
  EXPECT_EQ(matching.kinds[2], ReportKind::kInvented);
}

TEST(MatchPersons, CountsAReportBesideAMissedPersonAsItsMatch) {
  // Both reports are nearest to the first person; the second one is still near enough to the other.
  const auto matching = match_persons({standing_figure(0.0F), standing_figure(0.4F)},
                                      {standing_figure(0.0F), standing_figure(0.1F)}, kMaxDistance);
  EXPECT_EQ(matching.report_of_truth[1], 1U);
  EXPECT_EQ(matching.kinds[1], ReportKind::kMatched);
}

}  // namespace
}  // namespace limbcast::evaluate
