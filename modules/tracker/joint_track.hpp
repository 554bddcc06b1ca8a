#pragma once

#include <optional>

#include "common/human_model/body_pose.hpp"
#include "modules/tracker/tracker_params.hpp"

namespace limbcast::tracker {

/// One joint of one person over time.
class JointTrack {
 public:
  /// `max_acceleration_m_s2`: what this joint is capable of.
  JointTrack(const OneEuroParams& params, double max_acceleration_m_s2, double allowed_jump_m)
      : filter_(params),
        max_acceleration_m_s2_(max_acceleration_m_s2),
        allowed_jump_m_(allowed_jump_m) {}

  /// The joint as it was measured `elapsed_s` after the last frame. One that was left out is
  /// predicted, and one that jumped, until more frames say the same: the next one where they are
  /// sure, more where they are not.
  void update(const JointEstimate& measured, double elapsed_s, const PredictionParams& params);

  const JointEstimate& estimate() const { return estimate_; }

 private:
  bool has_jumped(const Eigen::Vector3f& measured_m) const;
  bool repeats_jump(const Eigen::Vector3f& measured_m) const;
  bool hold(const JointEstimate& measured);
  void take(const JointEstimate& measured);
  void predict(double elapsed_s, const PredictionParams& params);

  OneEuroFilter filter_;
  double max_acceleration_m_s2_, allowed_jump_m_;
  JointEstimate estimate_;
  std::optional<Eigen::Vector3f> jumped_to_m_;  ///< in the last frame
  float jump_support_ = 0.0F;                   ///< sum of the confidences of such a jump
  double blind_s_ = 0.0;                        ///< since the last measurement, taken or held
  double unseen_s_ = 0.0;                       ///< since the last measurement
};

}  // namespace limbcast::tracker
