#include "modules/tracker/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace limbcast::tracker {
namespace {

using Costs = std::vector<std::vector<double>>;
using Columns = std::vector<std::optional<std::size_t>>;

constexpr double kForbidden = std::numeric_limits<double>::infinity();

double total(const Costs& costs, const Columns& columns, double cost_alone) {
  double sum = 0.0;
  for (std::size_t row = 0; row < costs.size(); ++row)
    sum += columns[row] ? costs[row][*columns[row]] : cost_alone;
  return sum;
}

/// The least total over all pairings, by trying them all.
double least_total(const Costs& costs, std::size_t columns, double cost_alone) {
  // Numbers beyond the columns stand for "alone".
  std::vector<std::size_t> order(costs.size() + columns);
  std::iota(order.begin(), order.end(), 0U);
  double least = kForbidden;
  do {
    Columns tried;
    for (std::size_t row = 0; row < costs.size(); ++row)
      tried.push_back(order[row] < columns ? std::optional(order[row]) : std::nullopt);
    least = std::min(least, total(costs, tried, cost_alone));
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

TEST(Assign, PrefersTheBestSumToTheBestSinglePair) {
  const Columns columns = assign({{1.0, 2.0}, {2.0, 9.0}}, 2, 100.0);
  EXPECT_EQ(columns, (Columns{1, 0}));
}

TEST(Assign, LeavesAloneWhatIsDearerThanAlone) {
  EXPECT_EQ(assign({{1.0, kForbidden}, {kForbidden, kForbidden}}, 2, 10.0),
            (Columns{0, std::nullopt}));
  EXPECT_EQ(assign({{11.0}}, 1, 10.0), (Columns{std::nullopt}));
}

TEST(Assign, TakesNoRowsAndNoColumns) {
  EXPECT_TRUE(assign({}, 3, 10.0).empty());
  EXPECT_EQ(assign({{}, {}}, 0, 10.0), (Columns{std::nullopt, std::nullopt}));
}

TEST(Assign, IsAsCheapAsTheBestOfAllPairings) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> cost(0.0, 15.0);
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t rows = 1 + random() % 3, columns = 1 + random() % 4;
    Costs costs(rows, std::vector<double>(columns));
    for (auto& row : costs)
      for (double& entry : row) entry = random() % 4 == 0 ? kForbidden : cost(random);
    constexpr double kAlone = 10.0;
    const Columns paired = assign(costs, columns, kAlone);
    ASSERT_NEAR(total(costs, paired, kAlone), least_total(costs, columns, kAlone), 1e-9);
  }
}

}  // namespace
}  // namespace limbcast::tracker
