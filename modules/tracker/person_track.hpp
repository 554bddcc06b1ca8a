#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/human_model/body_pose.hpp"
#include "modules/tracker/arm_direction.hpp"
#include "modules/tracker/body_size.hpp"
#include "modules/tracker/joint_track.hpp"
#include "modules/tracker/tracker_params.hpp"
#include "modules/tracker/trunk_motion.hpp"

namespace limbcast::tracker {

/// One person over time.
class PersonTrack {
 public:
  PersonTrack(std::int32_t id, const BodyPose& first, const TrackerParams& params);

  /// The next frame was taken `elapsed_s` after the last one; update or miss follows.
  void advance(double elapsed_s);
  /// How badly that pose fits this person: half the squared distance in standard deviations, for
  /// place and body, plus the logarithm of how many places it could be. Infinite out of the gate.
  /// `down`: gravity.
  double cost(const BodyPose& pose, const Eigen::Vector3f& down) const;
  /// The pose stands where this person stands, seen a moment ago: there is no room for another.
  bool stands_at(const BodyPose& pose, const Eigen::Vector3f& down) const;
  void update(const BodyPose& measured);
  void miss();

  /// Not seen for too long to be known again.
  bool forgotten() const { return unseen_s_ > params_.identity.forget_after_s; }
  /// Seen now, or certain enough to be predicted.
  bool is_told() const;
  /// The smoothed pose; where it was not measured, the predicted one, so marked.
  BodyPose pose() const;

 private:
  BodyPose with_steady_sides(const BodyPose& pose);
  BodyPose expected() const;
  void restart_joints();
  Eigen::Vector3f seen_trunk(const BodyPose& pose) const;
  void remember_trunk(const BodyPose& pose, const Eigen::Vector3f& trunk_m);
  void update_arms(const std::vector<Pointing>& pointing);

  TrackerParams params_;
  BodyPose last_;  ///< as measured
  TrunkMotion motion_;
  BodySize size_;
  /// Where each joint was seen last as against the trunk's middle.
  std::array<std::optional<Eigen::Vector3f>, kJointCount> offsets_m_;
  std::vector<JointTrack> joints_;
  std::array<ArmDirection, 2> arms_;  ///< by Side
  double elapsed_s_ = 0.0, unseen_s_ = 0.0;
  int frames_seen_ = 0;
  int frames_for_sides_ = 0;  ///< that spoke for left and right as they are, less those against
};

}  // namespace limbcast::tracker
