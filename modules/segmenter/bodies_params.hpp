#pragma once

#include "modules/segmenter/growing_params.hpp"

namespace limbcast::segmenter {

/// What a body touches and is no part of it.
struct FurnitureParams {
  /// A limb is thinner than twice this [m]: two thighs side by side, a bent trunk from the side.
  float limb_radius_m = 0.11F;
  /// The trunk stands this near to the head's axis, across and behind [m].
  float trunk_radius_m = 0.35F, trunk_depth_m = 0.40F;
  /// Over the neck, this far below the head's centre, is only the head, hair and hat [m].
  float neck_m = 0.12F, head_radius_m = 0.25F;
  /// A surface ends where its depth over four pixels bends by this much [m], and by this many sigma
  /// of the depth's noise.
  float min_bend_m = 0.04F, bend_sigmas = 3.0F;
};

/// What is cut off from a cluster by the odds of its points (classifiers/body_classifier.hpp).
/// Chosen on the recording `seated` of rgbd_pointing and bodies D1 to D3 of stereo_dev.
struct BodyCutParams {
  /// Log odds below which a point is not taken for a body's. Lower: seats stay, higher: hands go.
  float min_body_odds = -1.0F;
  /// Above these a point that was cut may be a body's all the same: neither a body's nor free
  /// space.
  float min_unsure_odds = -2.0F;
  /// Connected points below min_body_odds count from this area on [m^2]: less is an error on a
  /// limb.
  float min_part_m2 = 0.06F;
  /// With less of them the body touches nothing, and the cluster is left whole [m^2]: an arm seen
  /// with its skirt.
  float min_other_m2 = 0.15F;
  /// Share of a cluster that must be left: a seated person keeps a third, a stain on a wall an
  /// eighth.
  float min_left_share = 0.2F;
};

/// Arms that the colour image shows and that growing or cutting left out (bodies/lost_arms.hpp). On
/// simulated people who point half of the forearms without a segment get theirs, and one to three
/// more of a hundred arms are right; limits twice as wide change nothing.
struct LostArmParams {
  /// Surfaces of nobody part where growing might go on: an arm from the wall.
  SurfaceParams surface = kPartedSurface;
  /// Least visibility of elbow and wrist.
  float min_visibility = 0.5F;
  /// A forearm and an upper arm with sleeves [m^2], and its larger level side [m].
  float max_area_m2 = 0.12F, max_extent_m = 0.8F;
  /// A hand is no farther from the head's surface [m]: an arm, and the shoulder beside the head.
  float max_head_distance_m = 1.1F;
  // Arms that were taken for heads: of 15 such pairs in 690 frames five are joined, all rightly.
  /// An arm's surface [m^2], and how many times as large the person's is at least.
  float max_taken_area_m2 = 0.1F, min_person_areas = 2.0F;
  /// Where the two segments began [m], and how far from the person's head the image may mark it
  /// [m].
  float max_seeds_apart_m = 0.7F, max_head_error_m = 0.2F;
};

/// People who bend down (bodies/split_bodies.hpp). Of simulated people before all sensors 62
/// segments of parts of bodies lie within these limits, and of 848 beside somebody else's none;
/// three of these do where one joint is enough.
struct SplitBodyParams {
  // What the network of depths must see to be believed about a head.
  float min_person_odds = 1.0F;       ///< log odds of a person
  float min_head_visibility = 0.35F;  ///< 0 to 1
  float max_head_spread_m = 0.05F;    ///< across the ray
  /// How far from its segment's seed such a head is at most, where others are its body's parts [m].
  float max_head_error_m = 0.25F;
  /// A segment in which the network sees a head so well and so near to the seed [m] is hardly a
  /// part of somebody else's.
  float min_own_head_visibility = 0.3F, max_own_head_error_m = 0.1F;
  /// A joint is seen, and lies on a segment no farther from its points than this [m].
  float min_joint_visibility = 0.4F, max_joint_distance_m = 0.2F;
  /// So many joints of the person's are in what is another part of the body; and so many where the
  /// network sees a head there too, but less plainly by this: of the same segments seven more, and
  /// still none of somebody else.
  int min_joints_in_part = 2, min_joints_beside_head = 4;
  float min_visibility_gap = 0.15F;
  /// Where two segments of one body began [m]: a trunk, a thigh and a head.
  float max_seeds_apart_m = 1.3F;
  /// A head so far from the seed is put right [m]: of 50 such (people who bend down, stand, sit and
  /// stand in groups) 45 are within 15 cm of the true head, the seed in two.
  float min_moved_m = 0.2F;
  /// Two segments whose heads are this near to one another are one body's [m]: no two heads are.
  float max_same_head_m = 0.15F;
};

/// Arms that growing did not reach (bodies/floating_arms.hpp). Of 141 such surfaces beside
/// simulated people before scanners 120 were parts of them, of 16 before depth cameras without
/// colours 13, of 59 before stereo pairs 40.
struct FloatingArmParams {
  /// Surfaces of nobody part where growing might go on: an arm from the wall.
  SurfaceParams surface = kPartedSurface;
  /// Less is a stray return, more is larger than an arm with its sleeve [m^2].
  float min_area_m2 = 0.002F, max_area_m2 = 0.12F;
  /// Largest step to the nearest of the person's points [m]: an upper arm.
  float max_from_person_m = 0.4F;
  /// What is this near to a second person too [m] may be either's; 0: is the nearest one's.
  float max_from_rival_m = 0.0F;
  /// Other surfaces of nobody's from this size on [m^2] stand at least this far off [m], or it is a
  /// part of theirs; smaller ones are stray returns.
  float min_other_m2 = 0.01F, min_gap_m = 0.15F;
  /// A hand is no farther from the head's centre [m]; arms that point hang no lower below it [m].
  float max_head_distance_m = 1.1F, max_below_head_m = 0.6F;
};

/// The same of clouds with colours: a stereo pair's has specks of its own, and the image tells of
/// arms too.
inline constexpr FloatingArmParams kFloatingArmsBesideImage = [] {
  FloatingArmParams params;
  params.min_area_m2 = 0.005F;
  params.max_from_person_m = 0.3F;
  params.max_from_rival_m = 0.6F;
  return params;
}();

}  // namespace limbcast::segmenter
