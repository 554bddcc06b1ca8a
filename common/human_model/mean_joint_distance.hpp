#pragma once

#include <optional>

#include "common/human_model/body_pose.hpp"

namespace limbcast {

/// Mean distance over the pairs of joints of which both are valid.
class MeanJointDistance {
 public:
  void add(const JointEstimate& a, const JointEstimate& b) {
    if (!a.valid || !b.valid) return;
    sum_m_ += (a.position_m - b.position_m).norm();
    ++count_;
  }

  /// [m]; nothing where no pair was valid.
  std::optional<float> mean_m() const {
    if (count_ == 0) return std::nullopt;
    return sum_m_ / static_cast<float>(count_);
  }

 private:
  float sum_m_ = 0.0F;
  int count_ = 0;
};

}  // namespace limbcast
