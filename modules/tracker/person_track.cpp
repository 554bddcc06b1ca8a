#include "modules/tracker/person_track.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/tracker/sides.hpp"

namespace limbcast::tracker {
namespace {

using Eigen::Vector3f;

/// The joints that move least as against each other.
constexpr std::array<Joint, 4> kTrunk = {Joint::kHead, Joint::kNeck, Joint::kChest, Joint::kPelvis};

struct Mean {
  Vector3f sum = Vector3f::Zero();
  int count = 0;
  void add(const Vector3f& value) {
    sum += value;
    ++count;
  }
  Vector3f value() const { return sum / static_cast<float>(std::max(1, count)); }
};

/// How far apart, level and along gravity.
struct Offset {
  Offset(const Vector3f& offset_m, const Vector3f& down)
      : vertical_m(std::abs(offset_m.dot(down))),
        level_m((offset_m - offset_m.dot(down) * down).norm()) {}
  double vertical_m, level_m;
};

double max_acceleration_m_s2(Joint joint, const JumpParams& params) {
  switch (joint) {
    case Joint::kElbowLeft:
    case Joint::kElbowRight:
    case Joint::kKneeLeft:
    case Joint::kKneeRight:
      return params.limb_acceleration_m_s2;
    case Joint::kWristLeft:
    case Joint::kWristRight:
    case Joint::kAnkleLeft:
    case Joint::kAnkleRight:
      return params.hand_acceleration_m_s2;
    default:
      return params.trunk_acceleration_m_s2;
  }
}

/// Middle of the trunk's known joints, of all known joints where none of the trunk is.
Vector3f middle(const BodyPose& pose) {
  Mean trunk, all;
  for (const Joint joint : kTrunk)
    if (pose[joint].valid) trunk.add(pose[joint].position_m);
  for (const JointEstimate& joint : pose.joints)
    if (joint.valid) all.add(joint.position_m);
  return trunk.count > 0 ? trunk.value() : all.value();
}

}  // namespace

PersonTrack::PersonTrack(std::int32_t id, const BodyPose& first, const TrackerParams& params)
    : params_(params),
      last_(first),
      motion_(middle(first), params.identity.motion),
      arms_{ArmDirection(params.pointing), ArmDirection(params.pointing)} {
  last_.id = id;
  restart_joints();
  remember_trunk(first, motion_.position_m());
  update(first);
}

void PersonTrack::advance(double elapsed_s) {
  elapsed_s_ = elapsed_s;
  motion_.predict(elapsed_s);
}

/// The trunk's middle as this pose shows it. Joints are compared with their own last place, so that
/// the middle does not jump when one of them is left out.
Vector3f PersonTrack::seen_trunk(const BodyPose& pose) const {
  Mean trunk;
  for (const Joint joint : kTrunk) {
    const auto& offset_m = offsets_m_[index(joint)];
    if (pose[joint].valid && offset_m) trunk.add(pose[joint].position_m - *offset_m);
  }
  return trunk.count > 0 ? trunk.value() : middle(pose);
}

void PersonTrack::remember_trunk(const BodyPose& pose, const Vector3f& trunk_m) {
  for (const Joint joint : kTrunk)
    if (pose[joint].valid) offsets_m_[index(joint)] = pose[joint].position_m - trunk_m;
}

double PersonTrack::cost(const BodyPose& pose, const Vector3f& down) const {
  const IdentityParams& identity = params_.identity;
  const double variance_m2 = motion_.measurement_variance_m2();
  const double vertical_variance_m2 =
      variance_m2 + identity.vertical_sigma_m * identity.vertical_sigma_m;
  const Offset offset(seen_trunk(pose) - motion_.position_m(), down);
  const double distance2 = offset.level_m * offset.level_m / variance_m2 +
                           offset.vertical_m * offset.vertical_m / vertical_variance_m2;
  const double difference = distance2 + size_.difference(pose, identity.length_sigma_m);
  if (difference > identity.gate_sigmas * identity.gate_sigmas)
    return std::numeric_limits<double>::infinity();
  // Of three axes; a person who may be anywhere must not outbid one who is expected just here.
  const double spread = 1.5 * std::log(variance_m2);
  return 0.5 * difference + spread;
}

void PersonTrack::restart_joints() {
  joints_.clear();
  for (int i = 0; i < kJointCount; ++i)
    joints_.emplace_back(params_.joints,
                         max_acceleration_m_s2(static_cast<Joint>(i), params_.jumps),
                         params_.jumps.distance_m);
}

BodyPose PersonTrack::expected() const {
  BodyPose pose;
  for (int i = 0; i < kJointCount; ++i) pose.joints[i] = joints_[i].estimate();
  return pose;
}

/// Nobody turns round between two frames: then the fitter took the back for the front, now or
/// before. What more frames said is believed.
BodyPose PersonTrack::with_steady_sides(const BodyPose& pose) {
  const bool exchanged = gain_of_exchange_m(expected(), pose) > params_.jumps.sides_gain_m;
  if (!exchanged) {
    frames_for_sides_ = std::min(frames_for_sides_ + 1, params_.jumps.frames_to_exchange);
    return pose;
  }
  if (--frames_for_sides_ >= 0) return with_sides_exchanged(pose);
  frames_for_sides_ = 1;
  restart_joints();
  return pose;
}

void PersonTrack::update(const BodyPose& measured) {
  const BodyPose pose = with_steady_sides(measured);
  const Vector3f trunk_m = seen_trunk(pose);
  motion_.update(trunk_m);
  remember_trunk(pose, trunk_m);
  size_.add(pose);
  for (int i = 0; i < kJointCount; ++i)
    joints_[i].update(pose.joints[i], elapsed_s_, params_.prediction);
  update_arms(pose.pointing);
  const std::int32_t id = last_.id;
  last_ = pose;
  last_.id = id;
  unseen_s_ = 0.0;
  ++frames_seen_;
}

void PersonTrack::miss() {
  unseen_s_ += elapsed_s_;
  for (JointTrack& joint : joints_) joint.update(JointEstimate{}, elapsed_s_, params_.prediction);
  update_arms({});
}

void PersonTrack::update_arms(const std::vector<Pointing>& pointing) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    ArmDirection& arm = arms_[static_cast<std::size_t>(side)];
    const auto said = std::find_if(pointing.begin(), pointing.end(),
                                   [side](const Pointing& p) { return p.side == side; });
    const bool arm_held = joints_[index(on_side(Joint::kElbowLeft, side))].estimate().predicted ||
                          joints_[index(on_side(Joint::kWristLeft, side))].estimate().predicted;
    if (said != pointing.end() && !arm_held) {
      arm.update(*said, elapsed_s_);
    } else {
      arm.miss(elapsed_s_, params_.prediction);
    }
  }
}

bool PersonTrack::stands_at(const BodyPose& pose, const Vector3f& down) const {
  const Offset offset(seen_trunk(pose) - motion_.position_m(), down);
  return offset.level_m < params_.identity.body_radius_m &&
         unseen_s_ <= params_.prediction.predict_s;
}

bool PersonTrack::is_told() const {
  if (unseen_s_ == 0.0) return true;
  return frames_seen_ >= params_.prediction.frames_to_trust &&
         unseen_s_ <= params_.prediction.predict_s;
}

BodyPose PersonTrack::pose() const {
  BodyPose pose = last_;
  pose.joints = expected().joints;
  pose.confidence *=
      static_cast<float>(std::exp(-unseen_s_ / params_.prediction.confidence_decay_s));
  pose.pointing.clear();
  for (const ArmDirection& arm : arms_)
    if (arm.pointing()) pose.pointing.push_back(*arm.pointing());
  std::stable_sort(
      pose.pointing.begin(), pose.pointing.end(),
      [](const Pointing& a, const Pointing& b) { return a.confidence > b.confidence; });
  return pose;
}

}  // namespace limbcast::tracker
