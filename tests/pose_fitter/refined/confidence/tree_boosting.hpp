#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/pose_fitter/refined/confidence/boosted_trees.hpp"

namespace limbcast::pose_fitter {

/// Cases, one a row, and whether they came true.
struct Cases {
  Eigen::MatrixXf features;
  std::vector<bool> positive;
};

/// Chosen by the loss on a quarter of the frames of a person's confidence that the other quarters
/// were trained for: 150 to 600 trees, rates of 0.04 to 0.1, leaves of 10 to 40 cases and priors of
/// 3 to 10 differ by less than the quarters do; all cases and all figures for every tree let a
/// quarter more things through (tests/accuracy).
struct BoostingParams {
  int trees = 400;
  /// So many rows of trees, each with draws of its own, are averaged: a single one tells of the
  /// same doubtful case 0.1 more or less, by what it happened to draw.
  int rows = 3;
  /// Share of each tree's best answer that is taken.
  double rate = 0.05;
  /// Fewest cases of a leaf.
  int min_leaf_cases = 10;
  /// Share of the cases that a tree is fitted to, drawn anew for each (J. Friedman, "Stochastic
  /// gradient boosting", 2002), and of the features that each row of its questions chooses from.
  double case_share = 0.5, feature_share = 0.3;
  /// Added to each leaf's second derivative of the loss, of which a case in full doubt has 0.25.
  double prior_weight = 5.0;
};

/// Trees whose sum is the logarithm of a case's odds (J. Friedman, "Greedy function approximation:
/// a gradient boosting machine", Annals of Statistics 29(5), 2001; splits by the second order, as
/// T. Chen and C. Guestrin, "XGBoost", KDD 2016). The draws have a fixed seed: the
/// same cases give the same trees.
std::vector<refined::Tree> boost_trees(const Cases& cases, const BoostingParams& params);

}  // namespace limbcast::pose_fitter
