#include "modules/tracker/arm_direction.hpp"

#include <cmath>

namespace limbcast::tracker {
namespace {

/// A direction that is not known is zero, and stays so.
Eigen::Vector3f smoothed(OneEuroFilter& filter, const Eigen::Vector3f& measured, double elapsed_s,
                         bool begins) {
  if (measured.isZero()) return measured;
  if (begins || !filter.started()) {
    filter.restart(measured);
  } else {
    filter.update(measured, elapsed_s);
  }
  return filter.value().normalized();
}

}  // namespace

void ArmDirection::update(const Pointing& measured, double elapsed_s) {
  const bool begins = !pointing_;
  const double since_measured_s = unseen_s_ + elapsed_s;
  pointing_ = measured;
  pointing_->direction = smoothed(direction_, measured.direction, since_measured_s, begins);
  pointing_->forearm = smoothed(forearm_, measured.forearm, since_measured_s, begins);
  pointing_->head_hand = smoothed(head_hand_, measured.head_hand, since_measured_s, begins);
  unseen_s_ = 0.0;
}

void ArmDirection::miss(double elapsed_s, const PredictionParams& params) {
  if (!pointing_) return;
  unseen_s_ += elapsed_s;
  pointing_->confidence *= static_cast<float>(std::exp(-elapsed_s / params.confidence_decay_s));
  if (unseen_s_ > params.predict_s) {
    pointing_.reset();
    unseen_s_ = 0.0;
  }
}

}  // namespace limbcast::tracker
