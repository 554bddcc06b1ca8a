#pragma once

#include <vector>

#include "modules/evaluate/evaluation.hpp"
#include "modules/evaluate/report.hpp"

namespace limbcast::evaluate {

/// What counts as rest, as motion, as the same person.
struct TrackingParams {
  float match_distance_m = 0.5F;     ///< as for single frames
  float rest_speed_m_s = 0.05F;      ///< a true joint that moves less rests
  float rest_speed_deg_s = 3.0F;     ///< a true direction that turns less rests
  int min_rest_frames = 5;           ///< shorter rests tell no deviation
  float moving_speed_m_s = 0.3F;     ///< a joint that moves more tells the lag
  float scene_cut_speed_m_s = 5.0F;  ///< nobody runs so: another recording begins
};

/// Sums over all people. Groups are what belongs together: one rest, or one joint of one person.
struct TrackingTally {
  int identity_switches = 0;  ///< a true person was followed under one number, then under another
  int followed = 0;           ///< true persons that were followed, in all frames
  using Groups = std::vector<std::vector<double>>;
  /// Distances of a joint's error from the middle of its errors during a rest [mm], in frames where
  /// both told the joint.
  Groups untracked_joints_mm, tracked_joints_mm;
  /// How much a joint's error changes from one such frame of a rest to the next [mm].
  Groups untracked_steps_mm, tracked_steps_mm;
  /// Distances from the middle, of pointing directions [degrees].
  Groups untracked_directions_deg, tracked_directions_deg;
  /// How far moving joints lag behind the untracked ones [frames], from their distance along the
  /// true motion.
  Groups lags_frames;
};

/// Compares untracked and tracked poses with the truth. Frames are paired as by evaluate(); true
/// persons of a sensor are told apart by their id, or by their place in the frame where ids are all
/// the same.
TrackingTally evaluate_tracking(const std::vector<TruthFrame>& truth,
                                const std::vector<BodyPoses>& untracked,
                                const std::vector<BodyPoses>& tracked,
                                const TrackingParams& params = {});

/// The figures to print. Identity switches as in K. Bernardin, R. Stiefelhagen, "Evaluating
/// Multiple Object Tracking Performance: The CLEAR MOT Metrics", EURASIP J. Image and Video
/// Processing, 2008.
std::vector<Figure> tracking_figures(const TrackingTally& tally);

}  // namespace limbcast::evaluate
