#pragma once

#include <string>

#include "modules/segmenter/networks/network_library.hpp"

namespace limbcast::segmenter {

/// Faces at the heads of people (faces_and_joints/face_finder.hpp). Chosen on bodies D1 to D3 of
/// stereo_dev and on simulated people (tests/accuracy/README.md).
struct FaceParams {
  bool enabled = true;
  NetworkLibrary library = network_libraries().front();  ///< that computes it
  /// What the network sees: a square around the head's centre [m]. With 0.5 and 1 it tells front
  /// from back as well, with 0.4 worse.
  float patch_m = 0.75F;
  /// Smallest side in the cloud's own pixels: faces get too small to see below. 6.8 m for VGA.
  float min_patch_px = 58.0F;
  /// A face's middle may be this far from the head's [m]: half a head, and the head's error.
  float reach_m = 0.13F;
  /// From this score on the face tells to which side it looks.
  float least_score = 0.0F;
  /// Log odds that a person faces the sensor: by score, and within which they stay. Of 1575
  /// simulated people who face the sensor or turn their backs 1.5 fronts for a back have a score of
  /// 0 to 0.5, 10 one of 0.5 to 1, 50 one over 1; hair, masks, hats and hands hide the others'
  /// faces. Real faces in plain sight score 1.3 to 3.8, which a simulated one rarely does.
  float facing_log_odds_at_zero = -0.5F, facing_log_odds_per_score = 3.8F;
  float least_facing_log_odds = -0.8F, most_facing_log_odds = 9.0F;
  /// Log odds of the side a face looks to, by how far the nose is from the middle of the ears [m],
  /// and at most: heads turn against the trunk.
  float side_log_odds_per_m = 30.0F, most_side_log_odds = 1.8F;
};

/// The network that sees joints in the colour image (faces_and_joints/pose_network.hpp). Chosen on
/// bodies D1 to D3 of stereo_dev/pointing and general with true heads, every second frame: 98 % of
/// the visible joints are within 10 cm across the ray; with the square around the true hips 95 %.
struct PoseNetworkParams {
  bool enabled = true;
  NetworkLibrary library = network_libraries().front();  ///< that computes it
  /// Middle of the square that the network sees, below the head's centre [m], and the square's side
  /// [m]: room for raised arms.
  float middle_below_head_m = 0.7F;
  float side_m = 2.3F;
  /// Smallest side in the cloud's own pixels: farther people are too small to see. 12 m for VGA.
  float min_side_px = 100.0F;
  /// Log odds of an unsure head: `base` + `depth_odds` times those of the depths around it +
  /// `score_odds` times those of the network's score + `distance_odds_per_m` times the distance to
  /// the head that the network marks. Logistic regression on 525 candidates of simulated groups and
  /// rooms and of stereo_dev: 91 % of the heads and 7 % of the rest are over 0; by the depths alone
  /// 63 and 10 %.
  float base_odds = 0.4F, depth_odds = 0.6F, score_odds = 0.67F, distance_odds_per_m = -8.3F;
  /// Limits of what the score and the distance tell: log odds, and [m].
  float max_score_odds = 4.0F, max_distance_m = 0.4F;
  /// What the network sees of a cloud without colours.
};

/// The square of the second network (faces_and_joints/move_net.hpp). Of the visible joints of
/// stereo_dev/multi it sees 92.7 % within 10 cm with a side of 2 m, 91.2 % with 2.3 and 89.3 % with
/// 1.8, with true silhouettes.
inline const PoseNetworkParams kSecondPoseNetwork = [] {
  PoseNetworkParams params;
  params.side_m = 2.0F;
  return params;
}();

/// What the network of depths sees (faces_and_joints/depth_pose.hpp); it was trained with these.
struct DepthPictureParams {
  /// Middle of the picture, below the head's centre [m], and its side [m]: room for raised arms.
  float middle_below_head_m = 0.7F;
  float side_m = 2.3F;
  /// What one unit of the picture's depths is [m], and the most units: as far as an arm reaches.
  float unit_m = 0.5F, most_units = 2.0F;
};

struct DepthPoseParams {
  bool enabled = true;
  NetworkLibrary library = network_libraries().front();  ///< that computes it
  DepthPictureParams picture;
  /// What the mirror image adds to a person's log odds at most; of 2485 candidates (20 simulated
  /// sets and rooms, demo.log, stereo_dev) two at most.
  float mirror_adds_odds = 3.0F;
  /// Below these log odds of a person the network of people who bow, kneel, sit on the ground or
  /// hold something large is asked, too, and believed where it is surer than the first, and than
  /// what is asked, by so much: without that a wall between somebody's head and hand is told.
  /// It was trained before cameras above all: in scans it must see a trunk that leans by more than
  /// this, too, or a real street without people gets one.
  float sure_person_odds = 4.0F, bent_surer_by = 1.0F;
  float min_scanned_lean_deg = 20.0F;
  /// Spread of a mark across the ray whose log odds to be there are zero [m], by what power of e it
  /// falls with each unit of them, and the most that is told [m]. Measured on simulated and
  /// recorded people; whether the joint is in sight tells nothing more.
  float even_odds_spread_m = 0.064F;
  float spread_log_slope = 0.76F;
  float max_spread_m = 0.3F;
};

}  // namespace limbcast::segmenter
