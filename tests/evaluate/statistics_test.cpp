#include "modules/evaluate/statistics.hpp"

#include <gtest/gtest.h>

namespace limbcast::evaluate {
namespace {

TEST(WilsonInterval, AgreesWithPublishedExamples) {
  // R. G. Newcombe, Statistics in Medicine 17 (1998), Table I, method 3: 81/263, 15/148, 0/20,
  // 1/29.
  const auto check = [](int count, int total, double low, double high) {
    const auto interval = wilson_interval(count, total);
    ASSERT_TRUE(interval);
    EXPECT_NEAR(interval->low, low, 5e-5);
    EXPECT_NEAR(interval->high, high, 5e-5);
  };
  check(81, 263, 0.2553, 0.3662);
  check(15, 148, 0.0624, 0.1605);
  check(0, 20, 0.0, 0.1611);
  check(1, 29, 0.0061, 0.1718);
}

TEST(WilsonInterval, EndsAtOneWhereAllCount) {
  EXPECT_DOUBLE_EQ(wilson_interval(20, 20)->high, 1.0);
  EXPECT_NEAR(wilson_interval(20, 20)->low, 1.0 - 0.1611, 5e-5);  // mirror of 0/20
}

TEST(WilsonInterval, IsNothingForNothing) { EXPECT_FALSE(wilson_interval(0, 0)); }

TEST(Quantile, InterpolatesBetweenValues) {
  EXPECT_FALSE(quantile({}, 0.5));
  EXPECT_DOUBLE_EQ(*quantile({7.0}, 0.9), 7.0);
  EXPECT_DOUBLE_EQ(*quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_DOUBLE_EQ(*quantile({1.0, 2.0}, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(*quantile({0.0, 10.0}, 0.9), 9.0);
}

TEST(Mean, IsNothingForNothing) {
  EXPECT_FALSE(mean({}));
  EXPECT_DOUBLE_EQ(*mean({1.0, 2.0, 6.0}), 3.0);
}

TEST(BootstrapInterval, HoldsTheStatisticAndRepeatsExactly) {
  std::vector<std::vector<double>> groups;
  for (int i = 0; i < 100; ++i) groups.push_back({static_cast<double>(i)});
  const Statistic statistic = [](const std::vector<double>& values) { return mean(values); };
  const auto first = bootstrap_interval(groups, statistic);
  const auto second = bootstrap_interval(groups, statistic);
  // Standard error of the mean of 0..99: 28.87 / 10 = 2.89, so about 49.5 +- 5.66.
  EXPECT_NEAR(first->low, 49.5 - 5.66, 0.6);
  EXPECT_NEAR(first->high, 49.5 + 5.66, 0.6);
  EXPECT_EQ(first->low, second->low);
  EXPECT_EQ(first->high, second->high);
}

TEST(BootstrapInterval, DrawsWholeGroups) {
  // Two groups that agree inside: the interval must span both, however many values they hold.
  const std::vector<std::vector<double>> groups = {std::vector<double>(50, 0.0),
                                                   std::vector<double>(50, 1.0)};
  const auto interval =
      bootstrap_interval(groups, [](const std::vector<double>& values) { return mean(values); });
  EXPECT_DOUBLE_EQ(interval->low, 0.0);
  EXPECT_DOUBLE_EQ(interval->high, 1.0);
}

TEST(BootstrapInterval, IsNothingForNothing) {
  EXPECT_FALSE(bootstrap_interval({}, [](const std::vector<double>& v) { return mean(v); }));
}

}  // namespace
}  // namespace limbcast::evaluate
