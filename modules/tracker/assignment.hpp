#pragma once

#include <optional>
#include <vector>

namespace limbcast::tracker {

/// The one-to-one pairing of rows and columns with the lowest sum of costs, where each row that
/// stays alone costs `cost_alone`: the column of each row, nothing for one that stays alone.
/// Hungarian method (H. W. Kuhn, Naval Research Logistics Quarterly 2, 1955) with potentials.
///
/// `costs[row][column]`, as long as `columns` in each row; infinity forbids a pair.
std::vector<std::optional<std::size_t>> assign(const std::vector<std::vector<double>>& costs,
                                               std::size_t columns, double cost_alone);

}  // namespace limbcast::tracker
