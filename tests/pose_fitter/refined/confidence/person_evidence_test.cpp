#include "modules/pose_fitter/refined/confidence/person_evidence.hpp"

#include <gtest/gtest.h>

#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

constexpr double kDistanceM = 2.5;

PersonEvidence evidence_of(const BodyState& body, const Segment& segment) {
  const auto observation = observe(segment, testing::stamp(), RefinedParams{});
  EXPECT_TRUE(observation);
  return gather_person_evidence(body, *observation);
}

const RegionLook& look_of(const PersonEvidence& evidence, Region region) {
  return evidence.regions[static_cast<std::size_t>(region)];
}

void move(const Vec3& by, BodyState& body) {
  for (Vec3& point : body.points) point += by;
}

TEST(PersonEvidence, OfAPersonInTheOpenIsItsOwnSurfaceWithAFreeOutline) {
  const BodyState body = testing::standing_body(kDistanceM, 0.0);
  const PersonEvidence evidence = evidence_of(body, testing::seen(body));

  for (const Region region : {Region::kHead, Region::kChest, Region::kThighs, Region::kShins}) {
    const RegionLook& look = look_of(evidence, region);
    EXPECT_GT(look.own, 0.6);
    EXPECT_LT(look.behind, 0.1);
    EXPECT_LT(look.misfit, 0.5);
  }
  EXPECT_GT(look_of(evidence, Region::kHead).beside_behind, 0.9);
  EXPECT_LT(evidence.unexplained_share, 0.02);
  EXPECT_GT(evidence.shins_upright, 0.95);
}

TEST(PersonEvidence, TellsWhereTheSensorSawThroughTheBody) {
  BodyState body = testing::standing_body(kDistanceM, 0.0);
  const Segment segment = testing::seen(body);
  // The left arm, to the image's right.
  for (const int point : {kElbow, kWrist, kHand}) body.points[point].x() += 0.15;

  const PersonEvidence evidence = evidence_of(body, segment);

  EXPECT_GT(look_of(evidence, Region::kForearms).behind, 0.3);
  EXPECT_LT(look_of(evidence, Region::kThighs).behind, 0.1);
}

TEST(PersonEvidence, TellsWhatHidesTheBody) {
  const BodyState body = testing::standing_body(kDistanceM, 0.0);

  const PersonEvidence evidence = evidence_of(body, testing::seen(body, 320));

  EXPECT_NEAR(look_of(evidence, Region::kChest).before, 0.5, 0.2);
  EXPECT_GT(look_of(evidence, Region::kHead).beside_before, 0.3);
}

TEST(PersonEvidence, TellsAWallThatTheOutlineIsPartOf) {
  const BodyState body = testing::standing_body(kDistanceM, 0.0);
  Segment segment = testing::seen(body);
  for (std::size_t i = 0; i < segment.range_image->depth_m.size(); ++i) {
    if (segment.range_image->labels[i] == PixelLabel::kOther)
      segment.range_image->depth_m[i] = static_cast<float>(kDistanceM);
  }

  const PersonEvidence evidence = evidence_of(body, segment);

  EXPECT_GT(look_of(evidence, Region::kHead).beside_level, 0.9);
  EXPECT_EQ(look_of(evidence, Region::kHead).beside_behind, 0.0);
}

TEST(PersonEvidence, TellsPointsThatTheBodyLeavesAndThoseInsideIt) {
  BodyState farther = testing::standing_body(kDistanceM, 0.0), nearer = farther;
  const Segment segment = testing::seen(farther);
  move({0.0, 0.0, 0.15}, farther);
  move({0.0, 0.0, -0.08}, nearer);

  EXPECT_GT(evidence_of(farther, segment).unexplained_share, 0.3);
  EXPECT_LT(evidence_of(farther, segment).inside_share, 0.1);
  EXPECT_GT(evidence_of(nearer, segment).inside_share, 0.3);
}

}  // namespace
}  // namespace limbcast::pose_fitter::refined
