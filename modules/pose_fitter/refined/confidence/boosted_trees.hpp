#pragma once

#include <array>
#include <cstddef>

namespace limbcast::pose_fitter::refined {

/// A decision tree of four questions in a row. Node k asks whether a feature is over a threshold;
/// its children are 2k + 1 (no) and 2k + 2 (yes), the last ones the leaves.
struct Tree {
  static constexpr std::size_t kQuestions = 15, kLeaves = 16;

  std::array<int, kQuestions> feature{};
  std::array<float, kQuestions> threshold{};
  std::array<float, kLeaves> value{};

  /// The value of the leaf that a case falls to.
  template <class Features>
  float value_of(const Features& features) const {
    std::size_t node = 0;
    while (node < kQuestions) node = 2 * node + (features[feature[node]] > threshold[node] ? 2 : 1);
    return value[node - kQuestions];
  }
};

}  // namespace limbcast::pose_fitter::refined
