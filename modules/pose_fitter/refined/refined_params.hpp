#pragma once

#include <array>

namespace limbcast::pose_fitter {

/// How much the search tries. Tuned.
struct SearchEffort {
  int starts_kept = 4;              ///< starts whose arms are searched
  int arm_postures_per_start = 16;  ///< tried for each arm of a start
  int arm_postures_per_move = 16;   ///< tried for each arm that moves
  int move_rounds = 3;              ///< of the moves of a pose
  int arms_combined = 2;            ///< fitted arms of each side that are tried together
  int poses_moved = 2;              ///< poses that the moves (flip, arms, legs) try to better
};

/// Numbers of the refined fitter. Where an origin says "tuned", it was chosen on the tuning half of
/// the rendered stereo and depth data; tests/accuracy/README.md has the figures.
struct RefinedParams {
  /// Points kept for the last refinement (a quarter of them during search). More is slower and a
  /// little more exact. Tuned.
  int target_points = 400;
  /// Fewest points that can be a person.
  int min_points = 40;
  /// Weight of a point against the priors, for each square of 3 cm that it stands for: neighbours
  /// in depth images share their errors, those of a scanner do less. Tuned.
  double point_weight = 0.375, scan_point_weight = 0.63;
  /// Points farther than this from the head's start are not the person's [m]: arm span of a tall
  /// man.
  double reach_m = 2.0;

  /// Spread of the surface about the round cones: clothes, hair, muscles [m]. Measured: 8 to 16 mm
  /// on true depth; the search uses more to widen the basin.
  double surface_sigma_m = 0.0215;
  double search_surface_sigma_m = 0.05;
  double arm_search_surface_sigma_m = 0.03;
  /// Residuals beyond this many sigmas stop counting (Geman-McClure). Tuned.
  double robust_sigmas = 2.04;
  /// Cost of a body part outside of the person's silhouette, against the surface and against a part
  /// before the surface that was seen: silhouettes are cut wrongly more often than depths are
  /// measured so. Tuned.
  double silhouette_weight = 0.5061;
  /// Joints against the rays on which the image's networks see them: spread across the ray [m] and
  /// weight against the surface, whose neighbouring points share their errors, of each network;
  /// limit of the robust loss. Tuned.
  std::array<double, 3> image_sigma_m = {0.0407, 0.025, 0.0331};
  std::array<double, 3> image_weight = {1.23, 2.603, 2.537};
  double image_limit_sigmas = 4.0;
  /// How much farther away than the hips each network tells joints to be: weight, and spread [m].
  /// The first tells too rough depths for a weight, the second none. Tuned on simulated people.
  std::array<double, 3> image_depth_weight = {0.0, 0.0, 0.7092};
  double image_depth_sigma_m = 0.049;
  /// A joint counts as this power of how sure its network is that it is in sight: the one that
  /// tells depths is mostly right about hidden joints too. Tuned on simulated people.
  std::array<double, 3> image_visibility_exponent = {1.0, 1.0, 0.115};
  /// The network of depths tells how far off each mark is: what is usual [m], the least that is
  /// believed [m], and the power of their ratio by which a mark's spreads above grow. Tuned on
  /// simulated people.
  double usual_mark_spread_m = 0.02, least_mark_spread_m = 0.0065;
  double mark_spread_exponent = 0.8295;
  /// A joint that it takes for hidden, and that a network of colours sees farther from there than
  /// this [m], counts less by up to this share. Tuned on simulated people.
  double image_elsewhere_m = 0.15;
  double image_elsewhere_doubt = 0.759;
  /// What a body costs whose left a network takes for right, as each does of one person in twenty.
  /// Tuned.
  double image_swap_cost = 6.0;
  /// A network of colours that marks both elbows and both wrists nearer to one another than this
  /// takes one arm for both, and tells of neither [m]. Tuned.
  double image_one_arm_m = 0.06;
  /// What a trunk turned against the face or the image costs for each unit of log odds, since
  /// neighbouring points share their errors. Tuned: of 1, 2, 4 and 8 the first two leave bodies
  /// back to front.
  double front_cost_per_log_odds = 4.0;
  /// Log odds that a trunk which the image's network sees from the side is turned as the network
  /// tells, less towards the front and the back. Measured: 142 of 145 simulated and recorded people
  /// who are turned by 53 degrees and more.
  double image_side_log_odds = 4.0;
  /// Log odds that a person's left is where the network of depths sees it. Measured: it takes left
  /// for right of 2 of 642 simulated, rendered and recorded people, those of colours of 49 and 34.
  double depth_side_log_odds = 6.0;
  /// Largest noise of the depth with which it is believed so [m]; it was trained with less. With 9
  /// cm (672 px, 5.5 m) it turned one of two people who were right.
  double depth_side_most_noise_m = 0.05;
  /// Where a face is seen more plainly [log odds] and it sees a back, it is not believed so: what
  /// somebody holds looks like one in depths. Of 195 looks at real people who hold a board, all
  /// turned to the camera, 19 were taken back to front, with faces of 2.8 and more, and two are.
  double plain_face_log_odds = 2.5;

  /// Rotations tried about gravity: every 30 degrees; the solver converges from 25 degrees away.
  int yaw_steps = 12;
  SearchEffort effort;
  /// Where the image shows the joints, fewer guesses find as much: joints within 10 cm, right arms
  /// and flips of 400 simulated and recorded people as with the full effort, in three quarters of
  /// the time; three poses moved find what pairs of arms found, in three quarters of that.
  SearchEffort effort_with_image{2, 8, 8, 2, 1, 3};
  /// Arms in other directions that the found one is compared with.
  int rival_arms = 6;
  /// Directions on the sphere for the upper arm and the forearm: 60 are 27 degrees apart.
  int arm_directions = 60;

  /// Mean stature [m] and spread of its logarithm: NHANES 2015-2018 adults, both sexes.
  double mean_stature_m = 1.70;
  double log_stature_sigma = 0.06;
};

}  // namespace limbcast::pose_fitter
