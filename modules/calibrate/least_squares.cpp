#include "modules/calibrate/least_squares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace limbcast::calibrate {
namespace {

/// Of the size of an unknown, of 1 at least: differences either way are then exact to its square,
/// and rounding far smaller than that.
constexpr double kDifference = 1e-5;
/// By so much a step is damped the more or the less after one that was bad or good, from the first
/// to what hardly moves (Marquardt 1963).
constexpr double kDampingFactor = 10.0, kFirstDamping = 1e-3, kLargestDamping = 1e12;

/// Changes of a view's residuals with each unknown of `x`.
template <class Vector, class Function>
Eigen::MatrixXd jacobian(const Function& residuals, const Vector& x, Eigen::Index num_residuals) {
  Eigen::MatrixXd J(num_residuals, x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double step = kDifference * std::max(1.0, std::abs(x[i]));
    Vector more = x;
    more[i] += step;
    Vector less = x;
    less[i] -= step;
    J.col(i) = (residuals(more) - residuals(less)) / (2.0 * step);
  }
  return J;
}

/// Normal equations of one view: shared unknowns (s) and pose (p).
struct ViewEquations {
  Eigen::MatrixXd ss, sp;
  Eigen::Matrix<double, 6, 6> pp;
  Eigen::VectorXd s;
  PoseVector p;
};

std::vector<ViewEquations> equations_at(const Residuals& residuals, const Unknowns& x) {
  std::vector<ViewEquations> equations;
  for (std::size_t view = 0; view < x.poses.size(); ++view) {
    const PoseVector& pose = x.poses[view];
    const Eigen::VectorXd errors = residuals(x.shared, pose, view);
    const Eigen::MatrixXd S =
        jacobian([&](const Eigen::VectorXd& shared) { return residuals(shared, pose, view); },
                 x.shared, errors.size());
    const Eigen::MatrixXd P =
        jacobian([&](const PoseVector& moved) { return residuals(x.shared, moved, view); }, pose,
                 errors.size());
    equations.push_back({S.transpose() * S, S.transpose() * P, P.transpose() * P,
                         -S.transpose() * errors, -P.transpose() * errors});
  }
  return equations;
}

/// Those of the shared unknowns alone: what is left of all views where the poses follow.
struct ReducedEquations {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
};

template <class Matrix>
Matrix damped(Matrix H, double damping) {
  H.diagonal() *= 1.0 + damping;
  return H;
}

ReducedEquations reduced(const std::vector<ViewEquations>& equations, double damping) {
  const Eigen::Index size = equations.front().s.size();
  ReducedEquations result{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  for (const ViewEquations& view : equations) {
    const auto pp = damped(view.pp, damping).ldlt();
    result.H += damped(view.ss, damping) - view.sp * pp.solve(view.sp.transpose());
    result.g += view.s - view.sp * pp.solve(view.p);
  }
  return result;
}

Unknowns stepped(const Unknowns& x, const std::vector<ViewEquations>& equations, double damping) {
  const ReducedEquations shared = reduced(equations, damping);
  const Eigen::VectorXd step = shared.H.ldlt().solve(shared.g);
  Unknowns result{x.shared + step, x.poses};
  for (std::size_t view = 0; view < x.poses.size(); ++view) {
    const ViewEquations& of_view = equations[view];
    result.poses[view] +=
        damped(of_view.pp, damping).ldlt().solve(of_view.p - of_view.sp.transpose() * step);
  }
  return result;
}

/// Sum of the squared residuals and their number.
struct Cost {
  double sum = 0.0;
  Eigen::Index count = 0;
};

Cost cost_of(const Residuals& residuals, const Unknowns& x) {
  Cost cost;
  for (std::size_t view = 0; view < x.poses.size(); ++view) {
    const Eigen::VectorXd errors = residuals(x.shared, x.poses[view], view);
    cost.sum += errors.squaredNorm();
    cost.count += errors.size();
  }
  return cost;
}

Eigen::VectorXd deviations_at(const Unknowns& x, const std::vector<ViewEquations>& equations,
                              const Cost& cost) {
  const Eigen::Index size = x.shared.size();
  const auto num_unknowns =
      size + PoseVector::SizeAtCompileTime * static_cast<Eigen::Index>(x.poses.size());
  const double variance = cost.sum / static_cast<double>(cost.count - num_unknowns);
  const Eigen::MatrixXd inverse =
      reduced(equations, 0.0).H.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
  return (variance * inverse.diagonal()).cwiseSqrt();
}

}  // namespace

LeastSquares least_squares(const Residuals& residuals, const Unknowns& start, int max_iterations,
                           double min_change) {
  Unknowns x = start;
  Cost cost = cost_of(residuals, x);
  std::vector<ViewEquations> equations = equations_at(residuals, x);
  double damping = kFirstDamping;
  for (int i = 0; i < max_iterations && damping < kLargestDamping; ++i) {
    const Unknowns next = stepped(x, equations, damping);
    const Cost next_cost = cost_of(residuals, next);
    if (!(next_cost.sum < cost.sum)) {  // also where it is no number
      damping *= kDampingFactor;
      continue;
    }
    const bool is_done = std::sqrt(next_cost.sum) > (1.0 - min_change) * std::sqrt(cost.sum);
    x = next;
    cost = next_cost;
    equations = equations_at(residuals, x);
    damping /= kDampingFactor;
    if (is_done) break;
  }
  return {x, deviations_at(x, equations, cost)};
}

}  // namespace limbcast::calibrate
