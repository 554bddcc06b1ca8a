#pragma once

#include "modules/pose_fitter/refined/evidence.hpp"

/// Probabilities as logistic regressions on evidence. tests/pose_fitter/train.sh fits their
/// coefficients (confidence_coefficients.inc) to people whose true joints are known.
namespace limbcast::pose_fitter::refined {

template <int count>
using Features = Eigen::Matrix<Real, count, 1>;
using JointFeatures = Features<9>;
using DirectionFeatures = Features<9>;
using PersonFeatures = Features<6>;

/// What tells that a joint is within 10 cm.
JointFeatures joint_features(const Evidence& evidence, int joint);
/// What tells that an arm's axis is right: a straight arm in sight, in a body that fits well,
/// without a rival, not behind the body or across it, where few people point but where arms end
/// that are missed or belong to a body taken back to front.
DirectionFeatures direction_features(const BodyState& body, const ArmEvidence& arm,
                                     const Evidence& evidence);
/// What tells a person from furniture, which fits a body too, but in an odd posture, as well from
/// the back, without limbs of its own and with a doubtful head.
PersonFeatures person_features(const Evidence& evidence);

Real joint_confidence(const Evidence& evidence, int joint);
Real direction_confidence(const BodyState& body, const ArmEvidence& arm, const Evidence& evidence);
Real person_confidence(const Evidence& evidence);

/// Root mean square of error over posterior spread: larger than 1, as neighbouring points share
/// their errors.
Real spread_scale();

}  // namespace limbcast::pose_fitter::refined
