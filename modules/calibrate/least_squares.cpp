#include "modules/calibrate/least_squares.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/LevenbergMarquardt>

namespace limbcast::calibrate {
namespace {

constexpr Eigen::Index kPoseSize = PoseVector::SizeAtCompileTime;
/// Of the size of an unknown, of 1 at least: differences either way are then exact to its square,
/// and rounding far smaller than that.
constexpr double kDifference = 1e-5;

Eigen::Index num_residuals(const Residuals& residuals, const Unknowns& x) {
  Eigen::Index count = 0;
  for (std::size_t view = 0; view < x.poses.size(); ++view)
    count += residuals(x.shared, x.poses[view], view).size();
  return count;
}

/// What Eigen's solver asks for. All unknowns are one vector there.
class Problem : public Eigen::SparseFunctor<double, int> {
 public:
  /// The poses come first, and stay there: with the shared unknowns, on which all residuals depend,
  /// at the end, the factors are about as sparse as the Jacobian.
  using QRSolver = Eigen::SparseQR<JacobianType, Eigen::NaturalOrdering<int>>;

  Problem(const Residuals& residuals, const Unknowns& start)
      : SparseFunctor(static_cast<int>(pose_begin(start.poses.size()) + start.shared.size()),
                      static_cast<int>(num_residuals(residuals, start))),
        residuals_(residuals),
        num_views_(start.poses.size()),
        num_shared_(start.shared.size()) {}

  InputType joined(const Unknowns& unknowns) const {
    InputType x(inputs());
    for (std::size_t view = 0; view < num_views_; ++view)
      x.segment<kPoseSize>(pose_begin(view)) = unknowns.poses[view];
    x.tail(num_shared_) = unknowns.shared;
    return x;
  }

  Unknowns parted(const InputType& x) const {
    Unknowns unknowns{x.tail(num_shared_), {}};
    for (std::size_t view = 0; view < num_views_; ++view)
      unknowns.poses.emplace_back(x.segment<kPoseSize>(pose_begin(view)));
    return unknowns;
  }

  /// All residuals.
  int operator()(const InputType& x, ValueType& errors) const {
    Eigen::Index row = 0;
    for (std::size_t view = 0; view < num_views_; ++view) {
      const Eigen::VectorXd of_view = residuals_of(view, x);
      errors.segment(row, of_view.size()) = of_view;
      row += of_view.size();
    }
    return 0;
  }

  /// Their changes with each unknown.
  int df(const InputType& x, JacobianType& J) const {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::Index row = 0;
    for (std::size_t view = 0; view < num_views_; ++view) {
      Eigen::Index num_rows = 0;
      const auto add_column = [&](Eigen::Index unknown) {
        const Eigen::VectorXd changes = changes_of(view, x, unknown);
        num_rows = changes.size();
        for (Eigen::Index i = 0; i < num_rows; ++i)
          entries.emplace_back(row + i, unknown, changes[i]);
      };
      for (Eigen::Index i = 0; i < kPoseSize; ++i) add_column(pose_begin(view) + i);
      for (Eigen::Index i = 0; i < num_shared_; ++i) add_column(pose_begin(num_views_) + i);
      row += num_rows;
    }
    J.setFromTriplets(entries.begin(), entries.end());
    return 0;
  }

 private:
  static Eigen::Index pose_begin(std::size_t view) {
    return kPoseSize * static_cast<Eigen::Index>(view);
  }

  Eigen::VectorXd residuals_of(std::size_t view, const InputType& x) const {
    return residuals_(x.tail(num_shared_), x.segment<kPoseSize>(pose_begin(view)), view);
  }

  Eigen::VectorXd changes_of(std::size_t view, const InputType& x, Eigen::Index unknown) const {
    const double step = kDifference * std::max(1.0, std::abs(x[unknown]));
    InputType more = x;
    more[unknown] += step;
    InputType less = x;
    less[unknown] -= step;
    return (residuals_of(view, more) - residuals_of(view, less)) / (2.0 * step);
  }

  const Residuals& residuals_;
  std::size_t num_views_;
  Eigen::Index num_shared_;
};

/// Of the last ones of the unknowns. `errors`: root of the sum of the squared residuals.
Eigen::VectorXd deviations(const Problem::JacobianType& J, double errors, Eigen::Index num_shared) {
  Eigen::MatrixXd last = Eigen::MatrixXd::Zero(J.cols(), num_shared);
  last.bottomRows(num_shared).setIdentity();
  const Eigen::SimplicialLDLT<Problem::JacobianType> normal_equations(J.transpose() * J);
  const Eigen::MatrixXd inverse = normal_equations.solve(last).bottomRows(num_shared);
  const double variance = errors * errors / static_cast<double>(J.rows() - J.cols());
  return (variance * inverse.diagonal()).cwiseSqrt();
}

}  // namespace

LeastSquares least_squares(const Residuals& residuals, const Unknowns& start, int max_iterations,
                           double min_change) {
  Problem problem(residuals, start);
  Eigen::LevenbergMarquardt<Problem> solver(problem);
  solver.setMaxfev(max_iterations);
  solver.setFtol(2.0 * min_change);  // of the squares
  Eigen::VectorXd x = problem.joined(start);
  solver.minimize(x);
  return {problem.parted(x), deviations(solver.jacobian(), solver.fnorm(), start.shared.size())};
}

}  // namespace limbcast::calibrate
