#pragma once

#include <algorithm>

namespace limbcast::segmenter {

/// The reach of a human: cylinder about the gravity axis through the seed (paper, III-B.1).
struct ReachParams {
  /// Radius [m]: head axis to finger tips, arm stretched sideways: half the arm span of a 1.9 m
  /// person, which equals half the stature (Vitruvius; ISO 7250 tables: 0.97 m).
  float radius_m = 1.0F;
  /// Above the seed [m]: a raised arm of a 1.9 m person reaches 0.65 m over the head's centre.
  float above_m = 0.75F;
  /// Below the seed [m]: head centre to sole of a 2.1 m person.
  float below_m = 2.0F;
};

/// Algorithm 1 of the paper.
struct PaperGrowingParams {
  /// d_max [m]: a step between adjacent points of a surface; 0.05 to 0.10 give the same clusters on
  /// stereo_dev/general, less breaks at 4 m (pixel spacing 9 mm, disparity step 30 mm).
  float max_distance_m = 0.06F;
  /// i_max: points whose neighbours are looked up. A person at 1.5 m covers 130,000 pixels of a VGA
  /// camera.
  int max_iterations = 200000;
};

/// What counts as one surface.
struct SurfaceParams {
  /// Longest step between neighbours at the depth z [m] grows with z^2, as depth noise does.
  float min_step_m = 0.06F;
  float step_per_m2 = 0.012F;
  float longest_step_m(float z_m) const { return std::max(min_step_m, step_per_m2 * z_m * z_m); }
  /// Points lower than this over the ground are ground [m]: two sigma of stereo noise and the
  /// plane's error.
  float ground_cut_m = 0.04F;
};

/// Half as far as growing steps: a limb or a body parts from the wall and from who stands before
/// it.
inline constexpr SurfaceParams kPartedSurface{0.05F, 0.006F};

/// Growing from all heads together.
struct JointGrowingParams : SurfaceParams {
  /// Longest way from the head along the surface [m]: crown to sole of a 2 m person, and a bend.
  float max_way_m = 2.4F;
  /// A step in depth costs this much more than one along the image: bodies that touch part there.
  float depth_step_cost = 0.5F;
  /// What hides a part of a body, an arm or another person, is at most this wide [m]: shoulders.
  float max_gap_m = 0.45F;
  /// Both sides of it differ at most this much in depth [m]: half the depth of a trunk and a tilt.
  float max_gap_depth_m = 0.20F;
  /// A way behind something costs this much more than one in sight, so that a point in sight of
  /// another head is that head's.
  float gap_cost = 2.0F;
  /// Connected surface [m^2] that may be a part of a body: less is noise of the matcher, more a
  /// wall.
  float min_part_m2 = 0.003F, max_part_m2 = 2.2F;
  /// Radius about the head's axis below these heights (share of the head's height): legs stay under
  /// the body.
  float shin_height = 0.30F, shin_radius_m = 0.75F;
  float knee_height = 0.45F, knee_radius_m = 0.85F;
  /// Points this near to the head's centre start the growing [m]: outer radius of a head.
  float head_radius_m = 0.15F;
};

}  // namespace limbcast::segmenter
