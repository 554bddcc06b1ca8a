#include "tests/pose_fitter/refined/confidence/logistic_regression.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace limbcast::pose_fitter {
namespace {

constexpr double kPriorSpread = 10.0;
constexpr int kMostSteps = 50;
constexpr double kLeastStep = 1e-9;

}  // namespace

double probability(const Eigen::VectorXd& coefficients, const Eigen::VectorXd& features) {
  return 1.0 / (1.0 + std::exp(-coefficients.dot(features)));
}

Eigen::VectorXd fit_logistic(const std::vector<Outcome>& outcomes) {
  const Eigen::Index count = outcomes.at(0).features.size();
  constexpr double kPriorInformation = 1.0 / (kPriorSpread * kPriorSpread);
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(count);
  for (int i = 0; i < kMostSteps; ++i) {
    Eigen::MatrixXd hessian = kPriorInformation * Eigen::MatrixXd::Identity(count, count);
    Eigen::VectorXd gradient = kPriorInformation * coefficients;
    for (const Outcome& outcome : outcomes) {
      const double told = probability(coefficients, outcome.features);
      gradient += (told - (outcome.positive ? 1.0 : 0.0)) * outcome.features;
      hessian += told * (1.0 - told) * outcome.features * outcome.features.transpose();
    }
    const Eigen::VectorXd step = hessian.llt().solve(gradient);
    coefficients -= step;
    if (step.norm() < kLeastStep) break;
  }
  return coefficients;
}

}  // namespace limbcast::pose_fitter
