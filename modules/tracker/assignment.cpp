#include "modules/tracker/assignment.hpp"

#include <algorithm>
#include <limits>

namespace limbcast::tracker {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The method proper, on a complete square table: adds one row after the other along the cheapest
/// alternating path. Index 0 of rows and columns stands for "none".
class Pairing {
 public:
  explicit Pairing(const std::vector<std::vector<double>>& costs)
      : costs_(costs),
        size_(costs.size()),
        row_potential_(size_ + 1, 0.0),
        column_potential_(size_ + 1, 0.0),
        row_of_column_(size_ + 1, 0) {
    for (std::size_t row = 1; row <= size_; ++row) add_row(row);
  }

  std::vector<std::size_t> column_of_row() const {
    std::vector<std::size_t> columns(size_);
    for (std::size_t column = 1; column <= size_; ++column)
      columns[row_of_column_[column] - 1] = column - 1;
    return columns;
  }

 private:
  double reduced_cost(std::size_t row, std::size_t column) const {
    return costs_[row - 1][column - 1] - row_potential_[row] - column_potential_[column];
  }

  void add_row(std::size_t row) {
    std::vector<double> slack(size_ + 1, kInfinity);
    std::vector<std::size_t> previous(size_ + 1, 0);
    std::vector<bool> visited(size_ + 1, false);
    row_of_column_[0] = row;
    std::size_t column = 0;
    do {
      visited[column] = true;
      column = cheapest_step(column, visited, slack, previous);
    } while (row_of_column_[column] != 0);
    while (column != 0) {
      row_of_column_[column] = row_of_column_[previous[column]];
      column = previous[column];
    }
  }

  /// The unvisited column that is cheapest to reach now; potentials are shifted so that it costs
  /// nothing more.
  std::size_t cheapest_step(std::size_t from, const std::vector<bool>& visited,
                            std::vector<double>& slack, std::vector<std::size_t>& previous) {
    std::size_t nearest = 0;
    double least = kInfinity;
    for (std::size_t column = 1; column <= size_; ++column) {
      if (visited[column]) continue;
      const double cost = reduced_cost(row_of_column_[from], column);
      if (cost < slack[column]) {
        slack[column] = cost;
        previous[column] = from;
      }
      if (slack[column] < least) {
        least = slack[column];
        nearest = column;
      }
    }
    for (std::size_t column = 0; column <= size_; ++column) {
      if (visited[column]) {
        row_potential_[row_of_column_[column]] += least;
        column_potential_[column] -= least;
      } else {
        slack[column] -= least;
      }
    }
    return nearest;
  }

  const std::vector<std::vector<double>>& costs_;
  std::size_t size_;
  std::vector<double> row_potential_, column_potential_;
  std::vector<std::size_t> row_of_column_;
};

}  // namespace

std::vector<std::optional<std::size_t>> assign(const std::vector<std::vector<double>>& costs,
                                               std::size_t columns, double cost_alone) {
  const std::size_t size = std::max(costs.size(), columns);
  // No entry costs more than staying alone, so a pair that stands for it never blocks a better one.
  std::vector<std::vector<double>> table(size, std::vector<double>(size, cost_alone));
  for (std::size_t row = 0; row < costs.size(); ++row)
    for (std::size_t column = 0; column < columns; ++column)
      table[row][column] = std::min(costs[row][column], cost_alone);
  const std::vector<std::size_t> paired = Pairing(table).column_of_row();
  std::vector<std::optional<std::size_t>> result(costs.size());
  for (std::size_t row = 0; row < costs.size(); ++row)
    if (paired[row] < columns && costs[row][paired[row]] < cost_alone) result[row] = paired[row];
  return result;
}

}  // namespace limbcast::tracker
