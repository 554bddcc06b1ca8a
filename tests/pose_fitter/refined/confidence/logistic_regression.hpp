#pragma once

#include <Eigen/Core>
#include <vector>

namespace limbcast::pose_fitter {

/// Features of one case (the first is 1) and whether it came true.
struct Outcome {
  Eigen::VectorXd features;
  bool positive = false;
};

/// Coefficients of least logistic loss by Newton's method. A weak prior (a spread of 10 about 0)
/// keeps them finite where the outcomes can be told without error.
Eigen::VectorXd fit_logistic(const std::vector<Outcome>& outcomes);

/// Probability that a case comes true.
double probability(const Eigen::VectorXd& coefficients, const Eigen::VectorXd& features);

}  // namespace limbcast::pose_fitter
