#pragma once

#include <array>

#include "modules/pose_fitter/refined/confidence/evidence.hpp"

/// What tells a person from a thing that a body fits too: how the sensor saw each region of the
/// body and its outline, the shape of what it saw, the body's posture and place.
namespace limbcast::pose_fitter::refined {

/// Parts of the body's surface, left and right in one.
enum class Region { kHead, kShoulders, kChest, kBelly, kUpperArms, kForearms, kThighs, kShins };
inline constexpr int kRegionCount = 8;

/// What the sensor saw where a region stands.
struct RegionLook {
  // Shares of the samples on the region's surface; at the others nothing was measured.
  Real own = 0.0;     ///< the person's surface, there
  Real other = 0.0;   ///< a surface there that is not the person's
  Real before = 0.0;  ///< something nearer
  Real behind = 0.0;  ///< something farther: the sensor saw through the region
  // Shares of the samples beside its outline that no other cone of the body covers.
  Real beside_behind = 0.0;  ///< something farther: the outline stands free
  Real beside_level = 0.0;   ///< a surface that goes on at the region's depth
  Real beside_before = 0.0;  ///< something nearer
  // The person's points nearest to the region.
  Real weight_share = 0.0;  ///< of the weight of all points
  Real misfit = 0.0;        ///< mean of the squared distances from the region [sigmas^2]
};

/// Beyond `Evidence`.
struct PersonEvidence {
  std::array<RegionLook, kRegionCount> regions;
  Real unexplained_share = 0.0;  ///< of the points' weight, farther off than clothes and noise are
  Real inside_share = 0.0;       ///< of it, deep inside the body
  /// Standard deviations of the points along their principal axes, smallest first [m]: of all, and
  /// of those nearest to the trunk.
  Vec3 extent_m = Vec3::Zero(), trunk_extent_m = Vec3::Zero();
  Real top_over_head_m = 0.0;  ///< highest point over the head's centre
  Real bottom_m = 0.0;         ///< lowest point over the floor
  Real ankle_height_m = 0.0;   ///< mean of both, over the floor
  Real noise_m = 0.0;          ///< standard deviation of the depth at the head
  Real head_moved_m = 0.0;     ///< from the first guess of its centre
  Real outside_share = 0.0;    ///< of the joints, beyond the image
  // Cosines of the angle to the vertical.
  Real trunk_upright = 0.0, neck_upright = 0.0, thighs_upright = 0.0, shins_upright = 0.0;
  Real face_log_odds = 0.0;  ///< of a face that was seen; 0 where none was
  bool guessed_head = false;
};

PersonEvidence gather_person_evidence(const BodyState& body, const Observation& observation);

}  // namespace limbcast::pose_fitter::refined
