#pragma once

#include "modules/tracker/one_euro_filter.hpp"
#include "modules/tracker/trunk_motion.hpp"

namespace limbcast::tracker {

/// Which pose is which person.
struct IdentityParams {
  /// A person who is not seen is known again within this time [s]: crossing, occlusion.
  double forget_after_s = 2.0;
  /// Largest difference from what was expected, of the trunk's place and the links' lengths
  /// together, in standard deviations; 4.5 loses one of 7000 places (chi-square with three degrees
  /// of freedom).
  double gate_sigmas = 4.5;
  /// Standard deviation of a link's length from frame to frame [m], for telling bodies apart.
  double length_sigma_m = 0.05;
  /// Standard deviation of a trunk's height besides [m]: a body fitted to a false head is too low
  /// or too high, but stands in the right place.
  double vertical_sigma_m = 0.15;
  /// Nobody new begins this near to somebody, measured level [m]: half a body's width.
  double body_radius_m = 0.25;
  TrunkMotionParams motion;
};

/// What a body cannot do between two frames: such a joint is taken for wrong unless the next frame
/// says the same.
struct JumpParams {
  /// Distance from the expected place that is allowed anyhow [m]: twice the error of a good joint.
  double distance_m = 0.08;
  /// Largest accelerations [m/s^2]: the trunk of somebody who stops within a step; elbows and
  /// knees; wrists and ankles, which fling. Chosen on simulated people who walk, wave and point.
  double trunk_acceleration_m_s2 = 8.0;
  double limb_acceleration_m_s2 = 20.0;
  double hand_acceleration_m_s2 = 40.0;
  /// Left and right count as exchanged if joints come nearer by this mean distance [m]: less than
  /// between the hips.
  double sides_gain_m = 0.1;
  /// So many frames with exchanged sides, at most, until they are believed.
  int frames_to_exchange = 10;
};

/// What is told of what was not measured.
struct PredictionParams {
  /// A joint or person is predicted this long [s]: a few frames; later it is left out.
  double predict_s = 0.4;
  /// Within this time a predicted joint comes to rest [s].
  double speed_decay_s = 0.2;
  /// A person is predicted once seen in this many frames: what is seen once may be none.
  int frames_to_trust = 3;
  /// How fast the standard deviation of a predicted joint grows [m/s]: slow movements of a limb.
  double sigma_growth_m_s = 0.3;
  /// Time in which the probability of a predicted joint falls to 37 % [s].
  double confidence_decay_s = 0.5;
};

struct TrackerParams {
  IdentityParams identity;
  OneEuroParams joints;
  /// Directions of pointing arms, as unit vectors: rad/s instead of m/s. The low cutoff averages
  /// over about a second while the arm rests.
  OneEuroParams pointing{0.2, 10.0, 0.25, 0.03, 1.0};
  JumpParams jumps;
  PredictionParams prediction;
};

}  // namespace limbcast::tracker
