#include "tests/pose_fitter/refined/confidence/tree_boosting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace limbcast::pose_fitter {
namespace {

/// Two features between -1 and 1; a case is positive where both have the same sign.
Cases same_signs(int count) {
  std::mt19937 random(1);
  Cases cases;
  cases.features.resize(count, 2);
  for (int i = 0; i < count; ++i) {
    for (int f = 0; f < 2; ++f)
      cases.features(i, f) = static_cast<float>(random()) / 2147483648.0F - 1.0F;
    cases.positive.push_back(cases.features(i, 0) * cases.features(i, 1) > 0.0F);
  }
  return cases;
}

double told(const std::vector<refined::Tree>& trees, float a, float b) {
  double log_odds = 0.0;
  for (const refined::Tree& tree : trees) log_odds += tree.value_of(Eigen::Vector2f(a, b));
  return 1.0 / (1.0 + std::exp(-log_odds));
}

TEST(TreeBoosting, TellsWhatOnlyTwoFeaturesTogetherTell) {
  const auto trees = boost_trees(same_signs(2000), BoostingParams{});

  EXPECT_GT(told(trees, 0.6F, 0.6F), 0.95);
  EXPECT_GT(told(trees, -0.6F, -0.6F), 0.95);
  EXPECT_LT(told(trees, 0.6F, -0.6F), 0.05);
  EXPECT_LT(told(trees, -0.6F, 0.6F), 0.05);
}

TEST(TreeBoosting, TellsTheShareWhereNothingSetsTheCasesApart) {
  Cases cases;
  cases.features = Eigen::MatrixXf::Zero(1000, 1);
  for (int i = 0; i < 1000; ++i) cases.positive.push_back(i % 4 == 0);

  const auto trees = boost_trees(cases, BoostingParams{});

  double log_odds = 0.0;
  for (const refined::Tree& tree : trees) log_odds += tree.value_of(Eigen::VectorXf::Zero(1));
  EXPECT_NEAR(1.0 / (1.0 + std::exp(-log_odds)), 0.25, 0.01);
}

TEST(TreeBoosting, IsTheMeanOfRowsThatDrawApart) {
  BoostingParams params;
  params.rows = 1;
  const auto one = boost_trees(same_signs(500), params);
  params.rows = 2;
  const auto two = boost_trees(same_signs(500), params);

  ASSERT_EQ(two.size(), 2 * one.size());
  int alike = 0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    for (std::size_t leaf = 0; leaf < refined::Tree::kLeaves; ++leaf)
      EXPECT_EQ(two[k].value[leaf], 0.5F * one[k].value[leaf]);
    if (two[one.size() + k].threshold == one[k].threshold) ++alike;
  }
  EXPECT_LT(alike, static_cast<int>(one.size()) / 10);
}

TEST(TreeBoosting, DrawsTheSameForTheSameCases) {
  const auto once = boost_trees(same_signs(500), BoostingParams{});
  const auto again = boost_trees(same_signs(500), BoostingParams{});

  ASSERT_EQ(once.size(), again.size());
  for (std::size_t k = 0; k < once.size(); ++k) {
    EXPECT_EQ(once[k].feature, again[k].feature);
    EXPECT_EQ(once[k].threshold, again[k].threshold);
    EXPECT_EQ(once[k].value, again[k].value);
  }
}

TEST(TreeBoosting, DrawsOtherCasesForEachTree) {
  // Nothing sets the cases apart: seen whole, each tree would go on where the one before ended.
  Cases cases;
  cases.features = Eigen::MatrixXf::Zero(100, 1);
  for (int i = 0; i < 100; ++i) cases.positive.push_back(i % 2 == 0);
  BoostingParams params;
  params.trees = 3;

  const auto trees = boost_trees(cases, params);

  const auto value = [&](std::size_t k) { return trees.at(k).value.front(); };
  EXPECT_NE(value(0), 0.0F);
  EXPECT_NE(value(0), value(1));
  EXPECT_NE(value(1), value(2));
}

TEST(TreeBoosting, KeepsAwayFromLeavesOfFewCases) {
  Cases cases;
  cases.features.resize(100, 1);
  for (int i = 0; i < 100; ++i) {
    cases.features(i, 0) = static_cast<float>(i);
    cases.positive.push_back(i < 3);
  }
  BoostingParams params;
  params.trees = 1;
  params.min_leaf_cases = 10;
  params.case_share = 1.0;

  const refined::Tree tree = boost_trees(cases, params).at(0);

  // The three that came true share their leaf with at least seven others.
  const auto value = [&](int i) { return tree.value_of(cases.features.row(i)); };
  EXPECT_EQ(value(0), value(9));
  EXPECT_GT(value(0), value(99));
}

}  // namespace
}  // namespace limbcast::pose_fitter
