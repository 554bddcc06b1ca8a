#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

namespace limbcast::calibrate {

/// From the board's frame to a camera's: Rodrigues vector, then shift.
using PoseVector = Eigen::Matrix<double, 6, 1>;

/// What is sought of several views of a board.
struct Unknowns {
  Eigen::VectorXd shared;         ///< by all views, e.g. the lens
  std::vector<PoseVector> poses;  ///< of the board, one for each view
};

/// By how much the points of a view are off.
using Residuals = std::function<Eigen::VectorXd(const Eigen::VectorXd& shared,
                                                const PoseVector& pose, std::size_t view)>;

struct LeastSquares {
  Unknowns unknowns;
  /// Standard deviations of the shared ones, as the residuals tell them.
  Eigen::VectorXd deviations;
};

/// The unknowns with the least sum of squared residuals near `start`, by Eigen's
/// Levenberg-Marquardt: sparse, as each view's residuals depend on one pose only. Ends after
/// `max_iterations` (steps tried), or where the sum's root falls by less than `min_change` of
/// itself.
LeastSquares least_squares(const Residuals& residuals, const Unknowns& start, int max_iterations,
                           double min_change);

}  // namespace limbcast::calibrate
