#include "modules/pose_fitter/refined/cost/cost.hpp"

#include <gtest/gtest.h>

#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter {
namespace {

using testing::kDegree;

TEST(FrontTerm, MindsATrunkTurnedAgainstTheFace) {
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

TEST(FrontTerm, TellsHowFarAFaceAgreesWithAFront) {
  auto observation = refined::observe(testing::seen(testing::standing_body(2.5, 0.0)),
                                      testing::stamp(), RefinedParams{});
  ASSERT_TRUE(observation);
  const auto agreement_at = [&](double yaw_deg) {
    return face_agreement(testing::standing_body(2.5, yaw_deg * kDegree).front(), *observation);
  };
  EXPECT_EQ(agreement_at(0.0), 0.0);
  // To which side it looks tells nothing: heads turn.
  observation->face = {2.0F, 1.5F};
  EXPECT_NEAR(agreement_at(0.0), 2.0, 1e-6);
  EXPECT_NEAR(agreement_at(90.0), 0.0, 1e-6);
  EXPECT_NEAR(agreement_at(180.0), -2.0, 1e-6);
  observation->face = {-2.0F, 0.0F};
  EXPECT_EQ(agreement_at(180.0), 0.0);
}

TEST(FrontTerm, TellsWhoIsSeenFromTheSide) {
  const auto observation = refined::observe(testing::seen(testing::standing_body(2.5, 0.0)),
                                            testing::stamp(), RefinedParams{});
  ASSERT_TRUE(observation);
  const auto sideways_at = [&](double yaw_deg) {
    return sideways(testing::standing_body(2.5, yaw_deg * kDegree).front(), *observation);
  };
  for (const double front_or_back : {0.0, 180.0})
    EXPECT_NEAR(sideways_at(front_or_back), 0.0, 1e-6);
  for (const double side : {-90.0, 90.0}) EXPECT_NEAR(sideways_at(side), 1.0, 1e-6);
}

TEST(FrontTerm, MindsATrunkTurnedAgainstTheDepths) {
  const RefinedParams params;
  Segment segment = testing::seen(testing::standing_body(2.5, 0.0));
  segment.image_poses = testing::in_depths(testing::standing_body(2.5, 90.0 * kDegree));
  const auto observation = refined::observe(segment, testing::stamp(), params);
  const double most =
      params.front_cost_per_log_odds * (params.image_side_log_odds + params.depth_side_log_odds);
  const auto cost_at = [&](double yaw_deg) {
    return front_cost(testing::standing_body(2.5, yaw_deg * kDegree), *observation, params);
  };
  EXPECT_NEAR(cost_at(90.0), 0.0, 0.01);
  EXPECT_NEAR(cost_at(-90.0), most, 0.01 * most);
}

TEST(FrontTerm, MindsLeftWhereTheDepthsShowRight) {
  const RefinedParams params;
  const refined::BodyState body = testing::standing_body(2.5, 0.0);
  Segment segment = testing::colored(testing::seen(body));
  segment.image_poses = testing::in_depths(body);
  const auto observation = refined::observe(segment, testing::stamp(), params);
  EXPECT_NEAR(front_cost(body, *observation, params), 0.0, 0.01);
  EXPECT_NEAR(front_cost(front_back_flipped(body), *observation, params),
              params.front_cost_per_log_odds * params.depth_side_log_odds, 0.01);
}

TEST(FrontTerm, BelievesAPlainFaceBeforeDepthsThatShowABack) {
  const RefinedParams params;
  const refined::BodyState body = testing::standing_body(2.5, 0.0);
  const double of_depths = params.front_cost_per_log_odds * params.depth_side_log_odds;
  const auto plain = static_cast<float>(params.plain_face_log_odds) + 1.0F;
  const auto cost_with_face = [&](float facing_log_odds, const refined::BodyState& seen_in_depths,
                                  const refined::BodyState& fitted) {
    Segment segment = testing::colored(testing::seen(body));
    segment.image_poses = testing::in_depths(seen_in_depths);
    auto observation = refined::observe(segment, testing::stamp(), params);
    observation->face = {facing_log_odds, 0.0F};
    return front_cost(fitted, *observation, params);
  };
  const refined::BodyState back = front_back_flipped(body);
  EXPECT_NEAR(cost_with_face(plain - 2.0F, back, body), of_depths, 0.01);
  EXPECT_NEAR(cost_with_face(plain, back, body), 0.0, 0.01);
  // Depths that show the front as the face does count as ever.
  EXPECT_NEAR(cost_with_face(plain, body, back), of_depths + params.front_cost_per_log_odds * plain,
              0.01);
}

TEST(FrontTerm, DoesNotMindTheDepthsSidesWhereTheirNoiseIsLarge) {
  const RefinedParams params;
  const refined::BodyState body = testing::standing_body(2.5, 0.0);
  Segment segment = testing::colored(testing::seen(body));
  segment.image_poses = testing::in_depths(body);
  Stamp stamp = testing::stamp();
  stamp.depth_noise = {2.0F * static_cast<float>(params.depth_side_most_noise_m), 0.0F};
  const auto observation = refined::observe(segment, stamp, params);
  EXPECT_NEAR(front_cost(front_back_flipped(body), *observation, params), 0.0, 0.01);
}

TEST(FrontTerm, MindsATrunkTurnedAgainstTheImage) {
  const RefinedParams params;
  const double most = params.front_cost_per_log_odds * params.image_side_log_odds;
  const auto cost_at = [&](double yaw_deg, double image_yaw_deg) {
    Segment segment = testing::colored(testing::seen(testing::standing_body(2.5, 0.0)));
    segment.image_poses = {testing::in_image(testing::standing_body(2.5, image_yaw_deg * kDegree))};
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

TEST(FrontTerm, MindsNoTrunkWhereTheImageTellsNoSides) {
  Segment segment = testing::seen(testing::standing_body(2.5, 0.0));
  segment.image_poses = {testing::in_image(testing::standing_body(2.5, 90.0 * kDegree))};
  for (ImageJoint& joint : segment.image_poses.front().joints) joint.visibility = 0.0F;
  const RefinedParams params;
  const auto observation = refined::observe(segment, testing::stamp(), params);
  EXPECT_EQ(front_cost(testing::standing_body(2.5, -90.0 * kDegree), *observation, params), 0.0);
}

}  // namespace
}  // namespace limbcast::pose_fitter
