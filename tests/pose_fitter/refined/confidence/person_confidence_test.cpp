#include <gtest/gtest.h>

#include <functional>

#include "modules/pose_fitter/refined/confidence/assessment.hpp"
#include "modules/pose_fitter/refined/confidence/confidence.hpp"
#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// A body fitted to what a sensor sees of somebody who stands 2.5 m away.
FittedBody standing_person() {
  const BodyState body = testing::standing_body(2.5, 0.0);
  Segment segment = testing::seen(body);
  segment.image_poses = testing::in_depths(body);
  segment.seed_kind = SeedKind::kHeadShape;
  segment.seed_score = 0.95F;
  auto fitted = fit_body(segment, testing::stamp(), RefinedParams{});
  EXPECT_TRUE(fitted);
  return *fitted;
}

/// The same with a head so doubtful, a posture so odd, joints so unsure and seen so poorly that the
/// confidence lies between `least` and `most`.
FittedBody doubtful_person(
    Real least, Real most, const std::function<void(FittedBody&)>& change = [](FittedBody&) {}) {
  FittedBody fitted = standing_person();
  const auto sigma_m = fitted.evidence.sigma_m;
  for (const Real unsure : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0}) {
    fitted.evidence.images.back().person_score = 1.0 / unsure;
    fitted.evidence.images.back().visibility.fill(1.0 / unsure);
    for (int i = 0; i < kPointCount; ++i) fitted.evidence.sigma_m[i] = unsure * sigma_m[i];
    change(fitted);
    for (const Real prior_cost : {10.0, 20.0, 30.0, 50.0, 80.0}) {
      fitted.evidence.prior_cost = prior_cost;
      for (fitted.evidence.head_odds = 3.0; fitted.evidence.head_odds > -5.0;
           fitted.evidence.head_odds -= 0.1) {
        const Real confidence = person_confidence(fitted);
        if (confidence > least && confidence < most) return fitted;
      }
    }
  }
  ADD_FAILURE() << "no doubt between " << least << " and " << most;
  return fitted;
}

constexpr DepthNoise kOfACamera{0.005F, 0.002F}, kOfAScanner{0.005F, 0.0F};

bool told_alone(const FittedBody& fitted) {
  const auto told = assess(fitted);
  return told && !told->needs_company;
}

TEST(PersonConfidence, IsHighOfSomebodyWhoStandsInTheOpen) {
  EXPECT_GT(person_confidence(standing_person()), 0.9);
}

TEST(PersonConfidence, MustBeHighWhereTheDepthIsNoisierThanItsTrainingWas) {
  FittedBody fitted = doubtful_person(0.76, 0.9);
  fitted.observation.has_colors = true;
  EXPECT_TRUE(told_alone(fitted));
  fitted.observation.noise.constant_m = 0.06F;
  EXPECT_FALSE(told_alone(fitted));
}

TEST(PersonConfidence, MustBeHigherBeforeAScanner) {
  FittedBody fitted = doubtful_person(0.76, 0.84);
  fitted.observation.noise = kOfACamera;
  EXPECT_TRUE(told_alone(fitted));
  fitted.observation.noise = kOfAScanner;
  EXPECT_FALSE(told_alone(fitted));
  EXPECT_FALSE(assess(fitted)) << "nor beside somebody";
}

TEST(PersonConfidence, MayBeLowerSoNearToACameraThatLegsAreOutOfSight) {
  FittedBody fitted = doubtful_person(0.5, 0.75);
  fitted.observation.noise = kOfACamera;
  EXPECT_FALSE(told_alone(fitted));
  fitted.body.points[kHead].z() = 1.2;
  EXPECT_TRUE(told_alone(fitted));
  fitted.observation.noise = kOfAScanner;
  EXPECT_FALSE(told_alone(fitted)) << "of a scanner";
}

TEST(PersonConfidence, MayBeLowerInCompany) {
  const auto of_a_camera = [](Real least, Real most) {
    FittedBody fitted = doubtful_person(least, most);
    fitted.observation.noise = kOfACamera;
    return assess(fitted);
  };
  const auto doubtful = of_a_camera(0.35, 0.5);
  ASSERT_TRUE(doubtful);
  EXPECT_TRUE(doubtful->needs_company);
  EXPECT_FALSE(of_a_camera(0.05, 0.35));
}

TEST(PersonConfidence, MayBeLowerOfSomebodyWhoseFaceIsInPlainSight) {
  FittedBody fitted = doubtful_person(0.35, 0.5);
  fitted.observation.noise = kOfACamera;
  const auto told_with = [&](float facing_log_odds) {
    fitted.observation.face.facing_log_odds = facing_log_odds;
    return told_alone(fitted);
  };
  EXPECT_TRUE(told_with(6.0F));
  EXPECT_FALSE(told_with(3.0F)) << "as simulated faces have";
}

TEST(PersonConfidence, IsNotEnoughWhereEveryJointButOneIsLikelierElsewhere) {
  FittedBody fitted = doubtful_person(0.8, 0.95);
  fitted.observation.noise = kOfACamera;
  const auto sigma_m = fitted.evidence.sigma_m;
  fitted.evidence.sigma_m.fill(0.2);
  fitted.evidence.sigma_m[kHead] = 0.1;
  fitted.evidence.sigma_m[kNeck] = sigma_m[kNeck];
  EXPECT_GT(person_confidence(fitted), 0.75);
  EXPECT_GT(joint_confidence(fitted.evidence, kHead), 0.1) << "enough for the head to be told";
  for (int i = 0; i < kJointCount; ++i)
    EXPECT_EQ(joint_confidence(fitted.evidence, i) > 0.5, i == kNeck) << i;
  EXPECT_FALSE(assess(fitted));
  fitted.evidence.sigma_m[kChest] = sigma_m[kChest];
  EXPECT_TRUE(assess(fitted));
}

TEST(PersonConfidence, MustBeHighInCompanyTooOfSomebodyWhoseHeadIsNotTold) {
  FittedBody doubtful = doubtful_person(0.4, 0.6), sure = standing_person();
  for (FittedBody* fitted : {&doubtful, &sure}) {
    fitted->observation.noise = kOfACamera;
    fitted->evidence.sigma_m[kHead] = 10.0;
  }
  ASSERT_LT(person_confidence(doubtful), 0.75) << "as the head's spread is evidence, too";
  EXPECT_FALSE(assess(doubtful));
  const auto told = assess(sure);
  ASSERT_TRUE(told);
  EXPECT_FALSE(told->pose[Joint::kHead].valid);
}

TEST(PersonConfidence, MustBeHigherOfSomebodyWhoseHeadWouldBeSeenAndIsNotTold) {
  // Of those whose head's spread leaves this much.
  FittedBody fitted =
      doubtful_person(0.76, 0.89, [](FittedBody& body) { body.evidence.sigma_m[kHead] = 10.0; });
  fitted.observation.noise = kOfACamera;
  EXPECT_FALSE(told_alone(fitted));
  fitted.observation.origin_v = -fitted.observation.full_height;  // the head is above the image
  EXPECT_TRUE(told_alone(fitted));
}

TEST(PersonConfidence, FallsWithADoubtfulHeadAndAnOddPosture) {
  FittedBody fitted = standing_person();
  const Real before = person_confidence(fitted);
  fitted.evidence.head_odds = -2.0;
  const Real doubtful_head = person_confidence(fitted);
  EXPECT_LT(doubtful_head, before);
  fitted.evidence.prior_cost = 100.0;
  EXPECT_LT(person_confidence(fitted), doubtful_head);
}

}  // namespace
}  // namespace limbcast::pose_fitter::refined
