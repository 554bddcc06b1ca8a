#include "modules/calibrate/least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limbcast::calibrate {
namespace {

/// Views of y = a exp(x) + p, with p the first number of the view's pose and a shared; the other
/// five are seen directly.
TEST(LeastSquares, FindsWhatViewsShareAndWhatEachHasForItself) {
  const double a = 2.0;
  const std::vector<double> shifts{0.5, -1.0, 3.0};
  const Residuals residuals = [&](const Eigen::VectorXd& shared, const PoseVector& pose,
                                  std::size_t view) {
    Eigen::VectorXd errors(10);
    for (int i = 0; i < 5; ++i) {
      errors[i] = shared[0] * shared[0] * std::exp(0.3 * i) + pose[0] -
                  (a * a * std::exp(0.3 * i) + shifts[view]);
      errors[5 + i] = pose[1 + i] - static_cast<double>(i);
    }
    return errors;
  };
  const Unknowns start{Eigen::VectorXd::Constant(1, 0.5),
                       std::vector<PoseVector>(shifts.size(), PoseVector::Zero())};
  const LeastSquares found = least_squares(residuals, start, 100, 1e-9);
  EXPECT_NEAR(found.unknowns.shared[0], a, 1e-6);
  for (std::size_t view = 0; view < shifts.size(); ++view) {
    EXPECT_NEAR(found.unknowns.poses[view][0], shifts[view], 1e-6);
    EXPECT_NEAR(found.unknowns.poses[view][4], 3.0, 1e-6);
  }
}

TEST(LeastSquares, TellsDeviationsAsALineHasThem) {
  // One number measured as 1, 2, 3 and 6 in each of two views: mean 3, and what the six numbers of
  // a pose are measured as has no error.
  const Residuals residuals = [](const Eigen::VectorXd& shared, const PoseVector& pose,
                                 std::size_t) {
    Eigen::VectorXd errors(10);
    errors << shared[0] - 1.0, shared[0] - 2.0, shared[0] - 3.0, shared[0] - 6.0, pose;
    return errors;
  };
  const Unknowns start{Eigen::VectorXd::Zero(1), std::vector<PoseVector>(2, PoseVector::Ones())};
  const LeastSquares found = least_squares(residuals, start, 100, 1e-9);
  EXPECT_NEAR(found.unknowns.shared[0], 3.0, 1e-6);
  // Squares 2 (4 + 1 + 0 + 9) = 28; 20 residuals - 13 unknowns; 8 measurements.
  EXPECT_NEAR(found.deviations[0], std::sqrt(28.0 / 7.0 / 8.0), 1e-6);
}

TEST(LeastSquares, StaysWhereNothingIsBetter) {
  const Residuals residuals = [](const Eigen::VectorXd&, const PoseVector& pose, std::size_t) {
    return Eigen::VectorXd(pose.cwiseAbs2() + PoseVector::Ones());
  };
  const Unknowns start{Eigen::VectorXd(0), {PoseVector::Zero()}};
  EXPECT_EQ(least_squares(residuals, start, 100, 1e-9).unknowns.poses[0], PoseVector::Zero());
}

}  // namespace
}  // namespace limbcast::calibrate
