#include "modules/evaluate/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace limbcast::evaluate {
namespace {

/// Two-sided 95 % of the normal distribution.
constexpr double kNormal95 = 1.959963985;
/// Enough for two digits of the bounds: Efron and Tibshirani, An Introduction to the Bootstrap
/// (1993), 19.3.
constexpr int kResamples = 1000;
constexpr unsigned kSeed = 20100000;

/// Evenly spread index; unlike std::uniform_int_distribution the same with every standard library.
std::size_t draw(std::mt19937& generator, std::size_t size) {
  return static_cast<std::size_t>((static_cast<std::uint64_t>(generator()) * size) >> 32U);
}

}  // namespace

std::optional<Interval> wilson_interval(int count, int total) {
  if (total <= 0) return std::nullopt;
  const double n = total, p = count / n, z2 = kNormal95 * kNormal95;
  const double center = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half =
      kNormal95 / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  return Interval{count == 0 ? 0.0 : center - half, count == total ? 1.0 : center + half};
}

std::optional<double> quantile(std::vector<double> values, double p) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const double place = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

std::optional<double> mean(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::optional<Interval> bootstrap_interval(const std::vector<std::vector<double>>& groups,
                                           const Statistic& statistic) {
  std::mt19937 generator(kSeed);
  std::vector<double> results;
  for (int i = 0; i < kResamples; ++i) {
    std::vector<double> sample;
    for (std::size_t k = 0; k < groups.size(); ++k) {
      const std::vector<double>& group = groups[draw(generator, groups.size())];
      sample.insert(sample.end(), group.begin(), group.end());
    }
    if (const auto result = statistic(sample)) results.push_back(*result);
  }
  if (results.empty()) return std::nullopt;
  return Interval{*quantile(results, 0.025), *quantile(results, 0.975)};
}

}  // namespace limbcast::evaluate
