#pragma once

#include <optional>

#include "common/human_model/body_pose.hpp"
#include "modules/tracker/tracker_params.hpp"

namespace limbcast::tracker {

/// Where one arm of one person points, averaged while it rests.
class ArmDirection {
 public:
  explicit ArmDirection(const OneEuroParams& params)
      : direction_(params), forearm_(params), head_hand_(params) {}

  /// `elapsed_s` after the last frame the arm points so.
  void update(const Pointing& measured, double elapsed_s);
  /// `elapsed_s` after the last frame the arm was not said to point.
  void miss(double elapsed_s, const PredictionParams& params);

  /// Nothing where the arm does not point.
  const std::optional<Pointing>& pointing() const { return pointing_; }

 private:
  OneEuroFilter direction_, forearm_, head_hand_;
  std::optional<Pointing> pointing_;
  double unseen_s_ = 0.0;
};

}  // namespace limbcast::tracker
