#include "tests/pose_fitter/refined/confidence/logistic_regression.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limbcast::pose_fitter {
namespace {

/// `positives` of `count` cases with the same feature beside the constant one.
void add_cases(double feature, int positives, int count, std::vector<Outcome>& outcomes) {
  for (int i = 0; i < count; ++i)
    outcomes.push_back({Eigen::Vector2d(1.0, feature), i < positives});
}

TEST(LogisticRegression, TellsTheSharesThatItWasMadeOn) {
  std::vector<Outcome> outcomes;
  add_cases(0.0, 1000, 4000, outcomes);
  add_cases(2.0, 3600, 4000, outcomes);

  const Eigen::VectorXd coefficients = fit_logistic(outcomes);

  // log(1 / 3), and what is left to log(9) on a feature of 2; the prior moves them a little.
  EXPECT_NEAR(coefficients[0], -std::log(3.0), 0.001);
  EXPECT_NEAR(coefficients[1], 0.5 * std::log(27.0), 0.001);
  EXPECT_NEAR(probability(coefficients, Eigen::Vector2d(1.0, 2.0)), 0.9, 0.001);
}

TEST(LogisticRegression, StaysFiniteWhereNothingIsUnsure) {
  std::vector<Outcome> outcomes;
  add_cases(-1.0, 0, 10, outcomes);
  add_cases(1.0, 10, 10, outcomes);

  const Eigen::VectorXd coefficients = fit_logistic(outcomes);

  EXPECT_TRUE(coefficients.allFinite());
  EXPECT_GT(probability(coefficients, Eigen::Vector2d(1.0, 1.0)), 0.99);
}

}  // namespace
}  // namespace limbcast::pose_fitter
