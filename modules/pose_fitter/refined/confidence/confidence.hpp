#pragma once

#include "modules/pose_fitter/refined/fitted_body.hpp"

/// Probabilities by evidence: logistic regressions, and boosted trees for a person's.
/// tests/pose_fitter/train.sh fits them (confidence_coefficients.inc, person_trees.inc) to people
/// whose true joints are known, and to things that are none.
namespace limbcast::pose_fitter::refined {

template <int count>
using Features = Eigen::Matrix<Real, count, 1>;
using JointFeatures = Features<10 + 3 * kImageNetworkCount>;
using FacingFeatures = Features<7 + kImageNetworkCount>;
using DirectionFeatures = Features<11 + 6 * kImageNetworkCount>;
using PersonFeatures = Eigen::Matrix<float, 9 * kRegionCount + 29 + 6 * kImageNetworkCount, 1>;

/// What tells that a joint is within 10 cm.
JointFeatures joint_features(const Evidence& evidence, int joint);
/// What tells that a body faces the way that it does: the one that faces the other way costs more,
/// and the face, the image's sides and the posture agree.
FacingFeatures facing_features(const Evidence& evidence);
/// What tells that an arm's axis is right, of a body that faces as it does: a straight arm in
/// sight, each of whose joints stands where the image shows it, which points where the depths show
/// it, in a body that fits well, without a rival, not behind the body or across it, where few
/// people point but where arms end that are missed.
DirectionFeatures direction_features(const BodyState& body, int side, const Evidence& evidence);
/// What tells a person from furniture, which fits a body too, but in an odd posture, as well from
/// the back, without limbs of its own, with a doubtful head, and goes on beside the body.
PersonFeatures person_features(const FittedBody& fitted);

Real joint_confidence(const Evidence& evidence, int joint);
Real facing_confidence(const Evidence& evidence);
/// Of a body that surely faces as it does.
Real direction_confidence(const BodyState& body, int side, const Evidence& evidence);
Real person_confidence(const FittedBody& fitted);

/// Root mean square of error over posterior spread: larger than 1, as neighbouring points share
/// their errors.
Real spread_scale();

}  // namespace limbcast::pose_fitter::refined
