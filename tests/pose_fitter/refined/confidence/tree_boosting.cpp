#include "tests/pose_fitter/refined/confidence/tree_boosting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace limbcast::pose_fitter {
namespace {

using refined::Tree;

/// Sums over some cases: first and second derivative of the loss by the log odds.
struct Derivatives {
  double gradient = 0.0, hessian = 0.0;
  int cases = 0;

  void add(const Derivatives& other) {
    gradient += other.gradient;
    hessian += other.hessian;
    cases += other.cases;
  }
  Derivatives without(const Derivatives& other) const {
    return {gradient - other.gradient, hessian - other.hessian, cases - other.cases};
  }
};

struct Split {
  int feature = 0;
  /// Over every value: a node that nothing splits well answers no.
  float threshold = std::numeric_limits<float>::max();
  double gain = 0.0;
};

/// The cases of each feature from the least to the largest.
std::vector<std::vector<int>> sorted_by_feature(const Eigen::MatrixXf& features) {
  std::vector<std::vector<int>> order(static_cast<std::size_t>(features.cols()));
  for (std::size_t f = 0; f < order.size(); ++f) {
    const auto column = features.col(static_cast<Eigen::Index>(f));
    order[f].resize(static_cast<std::size_t>(features.rows()));
    std::iota(order[f].begin(), order[f].end(), 0);
    std::stable_sort(order[f].begin(), order[f].end(),
                     [&](int a, int b) { return column[a] < column[b]; });
  }
  return order;
}

class Boosting {
 public:
  Boosting(const Cases& cases, const BoostingParams& params, unsigned seed)
      : cases_(cases),
        params_(params),
        order_(sorted_by_feature(cases.features)),
        log_odds_(Eigen::VectorXd::Zero(cases.features.rows())),
        derivatives_(static_cast<std::size_t>(cases.features.rows())),
        random_(seed),
        node_of_(derivatives_.size()) {}

  Tree next_tree() {
    for (std::size_t i = 0; i < derivatives_.size(); ++i) {
      derivatives_[i] = {};
      if (!drawn(params_.case_share)) continue;
      const double told = 1.0 / (1.0 + std::exp(-log_odds_[static_cast<Eigen::Index>(i)]));
      derivatives_[i] = {told - (cases_.positive[i] ? 1.0 : 0.0), told * (1.0 - told), 1};
    }
    std::fill(node_of_.begin(), node_of_.end(), 0);
    Tree tree;
    for (std::size_t first = 0; first < Tree::kQuestions; first = 2 * first + 1) split(first, tree);
    fill_leaves(tree);
    return tree;
  }

 private:
  bool drawn(double share) {
    return static_cast<double>(random_()) < share * static_cast<double>(std::mt19937::max());
  }
  /// At least one.
  std::vector<int> draw_features() {
    std::vector<int> features;
    while (features.empty()) {
      for (std::size_t f = 0; f < order_.size(); ++f)
        if (drawn(params_.feature_share)) features.push_back(static_cast<int>(f));
    }
    return features;
  }

  double loss_taken(const Derivatives& sums) const {
    return sums.gradient * sums.gradient / (sums.hessian + params_.prior_weight);
  }

  /// Splits all nodes of one level: `first` to 2 * `first`.
  void split(std::size_t first, Tree& tree) {
    std::array<Derivatives, Tree::kQuestions> all;
    for (std::size_t i = 0; i < node_of_.size(); ++i) all[node_of_[i]].add(derivatives_[i]);
    std::array<Split, Tree::kQuestions> best;
    for (const int feature : draw_features()) try_feature(feature, all, best);
    for (std::size_t node = first; node <= 2 * first; ++node) {
      tree.feature[node] = best[node].feature;
      tree.threshold[node] = best[node].threshold;
    }
    for (std::size_t i = 0; i < node_of_.size(); ++i) {
      const Split& taken = best[node_of_[i]];
      const float value = cases_.features(static_cast<Eigen::Index>(i), taken.feature);
      node_of_[i] = 2 * node_of_[i] + (value > taken.threshold ? 2 : 1);
    }
  }

  /// Each threshold between two values of a feature, for all nodes of a level at once.
  void try_feature(int feature, const std::array<Derivatives, Tree::kQuestions>& all,
                   std::array<Split, Tree::kQuestions>& best) const {
    std::array<Derivatives, Tree::kQuestions> below;
    std::array<float, Tree::kQuestions> last{};
    for (const int i : order_[static_cast<std::size_t>(feature)]) {
      const std::size_t node = node_of_[static_cast<std::size_t>(i)];
      const float value = cases_.features(i, feature);
      const Derivatives above = all[node].without(below[node]);
      if (value > last[node] && below[node].cases >= params_.min_leaf_cases &&
          above.cases >= params_.min_leaf_cases) {
        const double gain = loss_taken(below[node]) + loss_taken(above) - loss_taken(all[node]);
        if (gain > best[node].gain) best[node] = {feature, 0.5F * (last[node] + value), gain};
      }
      below[node].add(derivatives_[static_cast<std::size_t>(i)]);
      last[node] = value;
    }
  }

  void fill_leaves(Tree& tree) {
    std::array<Derivatives, Tree::kLeaves> sums;
    for (std::size_t i = 0; i < node_of_.size(); ++i)
      sums[node_of_[i] - Tree::kQuestions].add(derivatives_[i]);
    for (std::size_t k = 0; k < Tree::kLeaves; ++k) {
      tree.value[k] = static_cast<float>(-params_.rate * sums[k].gradient /
                                         (sums[k].hessian + params_.prior_weight));
    }
    for (std::size_t i = 0; i < node_of_.size(); ++i)
      log_odds_[static_cast<Eigen::Index>(i)] += tree.value[node_of_[i] - Tree::kQuestions];
  }

  const Cases& cases_;
  const BoostingParams& params_;
  std::vector<std::vector<int>> order_;
  Eigen::VectorXd log_odds_;
  std::vector<Derivatives> derivatives_;  ///< none of the cases that this tree does not see
  std::mt19937 random_;
  std::vector<std::size_t> node_of_;  ///< of each case, in the tree that grows
};

}  // namespace

std::vector<Tree> boost_trees(const Cases& cases, const BoostingParams& params) {
  std::vector<Tree> trees;
  for (int row = 0; row < params.rows; ++row) {
    Boosting boosting(cases, params, static_cast<unsigned>(row));
    for (int k = 0; k < params.trees; ++k) {
      trees.push_back(boosting.next_tree());
      for (float& value : trees.back().value) value /= static_cast<float>(params.rows);
    }
  }
  return trees;
}

}  // namespace limbcast::pose_fitter
