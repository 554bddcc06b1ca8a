#pragma once

#include <array>

#include "common/human_model/body_pose.hpp"

namespace limbcast::tracker {

/// Lengths by which bodies differ; both sides of a body count as one.
inline constexpr int kLengthCount = 8;

/// How long a person's links are, averaged over all frames.
class BodySize {
 public:
  void add(const BodyPose& pose);
  /// Mean squared difference of the lengths that both know, in variances of a measured length; 0
  /// where they share none.
  double difference(const BodyPose& pose, double length_sigma_m) const;

 private:
  std::array<double, kLengthCount> sums_m_{};
  std::array<int, kLengthCount> counts_{};
};

}  // namespace limbcast::tracker
