#include "modules/pose_fitter/refined/confidence/confidence.hpp"

#include <algorithm>
#include <cmath>

#include "common/units.hpp"
#include "modules/pose_fitter/refined/confidence/boosted_trees.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

#include "modules/pose_fitter/refined/confidence/confidence_coefficients.inc"
#include "modules/pose_fitter/refined/confidence/person_trees.inc"

/// Evidence beyond this many units of cost adds nothing.
constexpr Real kMostEvidence = 30.0, kMostGap = 15.0;
constexpr Real kLeastPriorCost = 0.1, kLeastSigmaM = 1e-4, kLeastSigmaDeg = 0.1;

Real strength(Real cost) { return std::log1p(std::clamp(cost, 0.0, kMostEvidence)); }
/// A posture or a surface that costs much tells of parts in wrong places.
Real odd_posture(const Evidence& evidence) {
  return std::log(std::max(kLeastPriorCost, evidence.prior_cost));
}
Real surface_misfit(const Evidence& evidence) { return evidence.surface_cost / evidence.weight; }

/// How far off the image's joints the ones from `first` to before `end` stand in the mean, 0 to 1,
/// those in sight counting more.
Real image_disagreement(const ImageEvidence& image, int first, int end) {
  Real sum = 0.0, weight = 1e-3;
  for (int i = first; i < end; ++i) {
    sum += image.visibility[i] * image.disagreement[i];
    weight += image.visibility[i];
  }
  return sum / weight;
}
/// How many of the joints from `first` to before `end` the image shows, in the mean.
Real image_visibility(const ImageEvidence& image, int first, int end) {
  Real sum = 0.0;
  for (int i = first; i < end; ++i) sum += image.visibility[i];
  return sum / (end - first);
}

/// Whether the networks of colours looked: the second never does alone.
bool is_told(const Evidence& evidence) { return evidence.images.front().told; }

bool in_depths(std::size_t network) {
  return network == static_cast<std::size_t>(ImageNetwork::kDepthPose);
}

/// How sure a network is that there is a person; as likely as not where that of depths, which
/// looked at everybody in training, did not.
Real person_score(const ImageEvidence& image, std::size_t network) {
  constexpr Real kAsLikelyAsNot = 0.5;
  return in_depths(network) && !image.told ? kAsLikelyAsNot : image.person_score;
}

/// Where colours are seen the marks of the network of depths, which real depth cameras mislead more
/// than simulated ones, tell nothing more of a joint.
const ImageEvidence& marks_that_count(const Evidence& evidence, std::size_t network) {
  static const ImageEvidence none;
  return in_depths(network) && evidence.has_colors ? none : evidence.images.at(network);
}

/// An arm this far off what the network of depths sees of it is half believed [degrees]: of
/// simulated arms that other evidence left unsure those up to 20 are right in 14 of 16, beyond in
/// half.
constexpr Real kHalfBelievedDeg = 15.0;

/// 1 where an arm points as the network of depths sees it, 0 far off or where it did not look.
Real seen_axis_agreement(const ArmEvidence& arm) {
  if (!arm.off_seen_axis_rad) return 0.0;
  const Real ratio = *arm.off_seen_axis_rad * kDegreesPerRadian<Real> / kHalfBelievedDeg;
  return 1.0 / (1.0 + ratio * ratio);
}

/// Mean over the points from `first` to before `end`.
Real mean_log_sigma(const Evidence& evidence, int first, int end) {
  Real sum = 0.0;
  for (int i = first; i < end; ++i) sum += std::log(std::max(kLeastSigmaM, evidence.sigma_m[i]));
  return sum / (end - first);
}

bool of_lower_arm(int point) { return point >= kElbow && point < kHip; }
/// Head, neck, chest and pelvis stay where they are when the body is flipped.
bool on_axis(int point) { return point < kShoulder; }

template <int count>
Real probability(const Features<count>& features, const Real (&coefficients)[count]) {
  const Real log_odds = features.dot(Eigen::Map<const Features<count>>(coefficients));
  return 1.0 / (1.0 + std::exp(-log_odds));
}

}  // namespace

JointFeatures joint_features(const Evidence& evidence, int joint) {
  const bool lower_arm = of_lower_arm(joint);
  JointFeatures features;
  auto list = features << 1.0;
  list, std::log(std::max(kLeastSigmaM, evidence.sigma_m[joint])),
      evidence.in_sight[joint] ? 1.0 : 0.0, odd_posture(evidence), surface_misfit(evidence),
      lower_arm ? 1.0 : 0.0, lower_arm ? strength(evidence.arms[(joint - kElbow) % 2].gap) : 0.0,
      on_axis(joint) ? 1.0 : 0.0, on_axis(joint) ? 0.0 : strength(evidence.flip_gap),
      is_told(evidence) ? 1.0 : 0.0;
  for (std::size_t network = 0; network < evidence.images.size(); ++network) {
    const ImageEvidence& image = marks_that_count(evidence, network);
    list, image.visibility[joint], image.visibility[joint] * image.disagreement[joint],
        on_axis(joint) ? 0.0 : image.sides_agreement;
  }
  return features;
}

FacingFeatures facing_features(const Evidence& evidence) {
  FacingFeatures features;
  auto list = features << 1.0;
  list, strength(evidence.flip_gap), evidence.has_colors ? 1.0 : 0.0, evidence.face_agreement,
      evidence.face_seen ? 1.0 : 0.0, evidence.sideways, odd_posture(evidence);
  for (std::size_t network = 0; network < evidence.images.size(); ++network)
    list, marks_that_count(evidence, network).sides_agreement;
  return features;
}

DirectionFeatures direction_features(const BodyState& body, int side, const Evidence& evidence) {
  const ArmEvidence& arm = evidence.arms[side];
  // The cost is per area of skin, of which a child has less.
  const Real size = kReferenceStatureM / body.stature_m();
  DirectionFeatures features;
  auto list = features << 1.0;
  list, std::clamp(arm.gap * size * size, 0.0, kMostGap), strength(arm.support),
      std::log(std::max(kLeastSigmaDeg, arm.sigma_rad * kDegreesPerRadian<Real>)), arm.bend_rad,
      odd_posture(evidence), std::min(1.0, surface_misfit(evidence)), arm.forwards,
      std::max(0.0, -arm.outwards), is_told(evidence) ? 1.0 : 0.0, seen_axis_agreement(arm);
  for (std::size_t network = 0; network < evidence.images.size(); ++network) {
    const ImageEvidence& image = marks_that_count(evidence, network);
    for (int joint = kShoulder + side; joint < kHip; joint += 2)
      list, image.visibility[joint], image.visibility[joint] * image.disagreement[joint];
  }
  return features;
}

PersonFeatures person_features(const FittedBody& fitted) {
  const Evidence& evidence = fitted.evidence;
  const PersonEvidence& person = fitted.person;
  Features<PersonFeatures::RowsAtCompileTime> features;
  auto list = features << person.unexplained_share;
  for (const RegionLook& look : person.regions) {
    list, look.own, look.other, look.before, look.behind, look.beside_behind, look.beside_level,
        look.beside_before, look.weight_share, look.misfit;
  }
  list, person.inside_share, person.extent_m, person.trunk_extent_m, person.top_over_head_m,
      person.bottom_m, person.ankle_height_m, person.noise_m, person.head_moved_m,
      person.outside_share, person.trunk_upright, person.neck_upright, person.thighs_upright,
      person.shins_upright, person.face_log_odds, person.guessed_head ? 1.0 : 0.0;
  list, is_told(evidence) ? 1.0 : 0.0;
  for (std::size_t network = 0; network < evidence.images.size(); ++network) {
    const ImageEvidence& image = evidence.images.at(network);
    list, person_score(image, network), image.sides_swapped ? 1.0 : 0.0,
        image_visibility(image, kShoulder, kJointCount),
        image_disagreement(image, kShoulder, kElbow), image_disagreement(image, kElbow, kHip),
        image_disagreement(image, kHip, kJointCount);
  }
  list, fitted.body.log_girth, odd_posture(evidence), surface_misfit(evidence),
      mean_log_sigma(evidence, kHead, kShoulder), mean_log_sigma(evidence, kShoulder, kJointCount),
      strength(evidence.shape_flip_gap),
      strength(evidence.arms[0].support) + strength(evidence.arms[1].support), evidence.head_odds;
  return features.cast<float>();
}

Real joint_confidence(const Evidence& evidence, int joint) {
  return probability(joint_features(evidence, joint), kJointCoefficients);
}

Real facing_confidence(const Evidence& evidence) {
  return probability(facing_features(evidence), kFacingCoefficients);
}

Real direction_confidence(const BodyState& body, int side, const Evidence& evidence) {
  return probability(direction_features(body, side, evidence), kDirectionCoefficients);
}

Real person_confidence(const FittedBody& fitted) {
  const PersonFeatures features = person_features(fitted);
  Real log_odds = 0.0;
  for (const Tree& tree : kPersonTrees) log_odds += tree.value_of(features);
  return 1.0 / (1.0 + std::exp(-log_odds));
}

Real spread_scale() { return kSpreadScale; }

}  // namespace limbcast::pose_fitter::refined
