#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace limbcast::evaluate {

/// Bounds of a 95 % confidence interval.
struct Interval {
  double low = 0.0, high = 0.0;
};

/// Wilson's score interval of the share count / total (E. B. Wilson, J. Am. Stat. Assoc. 22, 1927):
/// stays right near 0 and 1, where the goals lie. Nothing for total = 0.
std::optional<Interval> wilson_interval(int count, int total);

/// Value below which the share `p` (0 to 1) of the values lies, interpolated linearly. Nothing for
/// none.
std::optional<double> quantile(std::vector<double> values, double p);
std::optional<double> mean(const std::vector<double>& values);

using Statistic = std::function<std::optional<double>(const std::vector<double>&)>;
/// Percentile bootstrap (B. Efron, Ann. Stat. 7, 1979) with a fixed seed. Whole groups are drawn:
/// errors of one person's joints hang together, so single joints would make the interval too
/// narrow.
std::optional<Interval> bootstrap_interval(const std::vector<std::vector<double>>& groups,
                                           const Statistic& statistic);

}  // namespace limbcast::evaluate
