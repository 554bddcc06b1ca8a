#include "modules/tracker/joint_track.hpp"

#include <cmath>

namespace limbcast::tracker {
namespace {

/// A jump is believed from this sum of confidences on: two frames that are sure of it, three or
/// more that are not.
constexpr float kSupportOfJump = 1.6F;

}  // namespace

void JointTrack::update(const JointEstimate& measured, double elapsed_s,
                        const PredictionParams& params) {
  unseen_s_ += elapsed_s;
  blind_s_ += elapsed_s;
  if (measured.valid && !hold(measured)) {
    take(measured);
  } else if (estimate_.valid) {
    predict(elapsed_s, params);
  }
  if (measured.valid) blind_s_ = 0.0;
}

/// True where the joint has jumped and not enough speaks for that yet.
bool JointTrack::hold(const JointEstimate& measured) {
  if (!estimate_.valid || !has_jumped(measured.position_m)) {
    jumped_to_m_.reset();
    return false;
  }
  const float support_before = repeats_jump(measured.position_m) ? jump_support_ : 0.0F;
  jump_support_ = support_before + measured.confidence;
  if (support_before > 0.0F && jump_support_ >= kSupportOfJump) return false;
  jumped_to_m_ = measured.position_m;
  return true;
}

bool JointTrack::has_jumped(const Eigen::Vector3f& measured_m) const {
  const Eigen::Vector3f expected_m =
      filter_.measured() + filter_.speed() * static_cast<float>(blind_s_);
  return (measured_m - expected_m).norm() >
         allowed_jump_m_ + 0.5 * max_acceleration_m_s2_ * blind_s_ * blind_s_;
}

/// Nearer to where it jumped than to where it was before.
bool JointTrack::repeats_jump(const Eigen::Vector3f& measured_m) const {
  return jumped_to_m_ &&
         (measured_m - *jumped_to_m_).norm() < (measured_m - estimate_.position_m).norm();
}

void JointTrack::take(const JointEstimate& measured) {
  if (!estimate_.valid || jumped_to_m_) {
    // At rest, for what jumps to and fro, as a hidden arm does, has no speed that lasts.
    filter_.restart(measured.position_m);
    jumped_to_m_.reset();
  } else {
    filter_.update(measured.position_m, unseen_s_);
  }
  // Sigma and confidence stay the fitter's: what it gets wrong in all frames alike does not average
  // out.
  estimate_ = measured;
  estimate_.position_m = filter_.value();
  unseen_s_ = 0.0;
}

void JointTrack::predict(double elapsed_s, const PredictionParams& params) {
  if (unseen_s_ > params.predict_s) {
    jumped_to_m_.reset();
    estimate_ = JointEstimate{};
    unseen_s_ = 0.0;
    return;
  }
  filter_.predict(elapsed_s, params.speed_decay_s);
  estimate_.predicted = true;
  estimate_.position_m = filter_.value();
  estimate_.sigma_m += static_cast<float>(params.sigma_growth_m_s * elapsed_s);
  estimate_.confidence *= static_cast<float>(std::exp(-elapsed_s / params.confidence_decay_s));
}

}  // namespace limbcast::tracker
