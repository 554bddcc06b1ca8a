#include "modules/pose_fitter/refined/cost/cost.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "modules/pose_fitter/refined/search/solver.hpp"
#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter {
namespace {

using refined::BodyState;
using testing::kDegree;

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

TEST(RefinedCost, HasTheGradientOfItsDifferencesByThePoints) {
  BodyState body = testing::standing_body(2.5, 20.0 * kDegree);
  const Segment segment = testing::seen(body);
  const RefinedParams params;
  const auto observation = refined::observe(segment, testing::stamp(), params);
  ASSERT_TRUE(observation);
  // Off the minimum, so that the gradient is not zero.
  for (auto& point : body.points) point += Eigen::Vector3d(0.01, -0.008, 0.012);
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

}  // namespace
}  // namespace limbcast::pose_fitter
