#pragma once

#include <optional>
#include <vector>

#include "modules/pose_fitter/refined/cost/image_term.hpp"
#include "modules/pose_fitter/refined/search/pose_moves.hpp"

namespace limbcast::pose_fitter::refined {

/// What speaks for one arm of a fitted body.
struct ArmEvidence {
  Real support = 0.0;    ///< cost that leaving the arm out would add
  Real gap = 0.0;        ///< cost that the best body facing as this one, but with this arm in
                         ///< another direction, would add
  Real bend_rad = 0.0;   ///< upper arm against forearm
  Real sigma_rad = 0.0;  ///< of the arm axis, from the posterior covariance
  Real forwards = 0.0;   ///< cosine of the arm axis and the body's front
  Real outwards = 0.0;   ///< cosine of the arm axis and the body's side of this arm
  /// Between the arm axis and what the network that tells depths sees of it; nothing: none looked.
  std::optional<Real> off_seen_axis_rad{};
};

/// What speaks for a fitted body.
struct Evidence {
  std::array<ArmEvidence, 2> arms;
  Real flip_gap = 0.0;        ///< cost that the best body facing the other way would add
  Real shape_flip_gap = 0.0;  ///< the same without what `front_cost` tells
  Real face_agreement = 0.0;  ///< log odds by which a face that was seen speaks for the front
  bool face_seen = false, has_colors = false;
  Real sideways = 0.0;   ///< of the front, 0 to 1: 1 of somebody seen from the side
  Real weight = 0.0;     ///< of all points
  Real head_odds = 0.0;  ///< logarithm of the odds that the segment began at a head
  std::array<ImageEvidence, kImageNetworkCount> images;  ///< of each network
  Real surface_cost = 0.0, prior_cost = 0.0;
  std::array<Real, kPointCount> sigma_m{};   ///< of each point along its worst axis
  std::array<bool, kPointCount> in_sight{};  ///< nothing seen before it, in the image
};

Evidence gather_evidence(const std::vector<PoseCandidate>& candidates, PoseMoves& moves);

}  // namespace limbcast::pose_fitter::refined
