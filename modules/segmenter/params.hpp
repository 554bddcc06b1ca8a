#pragma once

#include <array>
#include <cstdint>

#include "modules/segmenter/bodies_params.hpp"
#include "modules/segmenter/growing_params.hpp"
#include "modules/segmenter/image_params.hpp"

namespace limbcast::segmenter {

/// Where growing starts.
enum class SeedSource : std::int8_t {
  kAuto,   ///< heads by shape, with skin as a mark on them; the paper's growing starts from both
  kSkin,   ///< skin-coloured parts (the paper)
  kShape,  ///< heads found by their shape
  kBoth,   ///< skin and shape
};

/// How a cluster grows from its seed.
enum class Growing : std::int8_t {
  kRefined,  ///< all heads together, along the surface, without the ground
  kPaper,    ///< Algorithm 1, one seed after the other
};

/// What answers "which points are near" for Algorithm 1.
enum class SearchStructure : std::int8_t {
  kAuto,     ///< the lattice for an organised cloud, the kd-tree for any other
  kKdTree,   ///< the paper's choice
  kLattice,  ///< organised clouds only
};

/// Ground plane, started from gravity. Only points above it can belong to a person.
struct GroundParams {
  /// Height the ground is searched under the sensor [m]: robots' sensors stand between these.
  float min_sensor_height_m = 0.25F;
  float max_sensor_height_m = 2.6F;
  /// Largest angle between the ground's normal and gravity [rad]: error of an inertial unit (0.5
  /// degrees) and slope of indoor floors and yards. Larger takes ramps, and furniture, for ground.
  float max_tilt_rad = 0.05F;
  /// Points this far from the plane take part in its last fit [m]: three sigma of stereo at 3 m.
  float inlier_distance_m = 0.04F;
  /// Share of the cloud that must lie on the plane; with less no ground is in sight.
  float min_share = 0.02F;
  /// How far it must spread in its narrower direction (standard deviation) where nobody told the
  /// sensor's height [m], as in GroundPlaneParams. The lower end of a man's trunk, which all of 19
  /// pictures of a real depth camera had for the ground without this, spreads by up to 0.05 m; of
  /// 15 true grounds that were seen so 14 spread by 0.34 to 1.1 m.
  float min_extent_m = 0.12F;
};

/// Ring template on the depth image.
struct HeadShapeParams {
  /// Depth where heads are searched [m].
  float min_depth_m = 0.5F, max_depth_m = 8.0F;
  /// Height of a head's centre over the ground [m]: a sitting child, a tall person.
  float min_height_m = 0.50F, max_height_m = 2.15F;
  /// Largest noise of the depth there [m]: beyond, a bare wall has relief like a head's.
  float max_noise_m = 0.07F;
  /// Lowest score of a candidate; the score runs from 0 to 2.48. Low: the classifier tells more.
  float min_score = 1.5F;
  /// Candidates nearer than this to a better one are left out [m]. A hand beside a head must not
  /// hide it.
  float separation_m = 0.14F;
  /// Strongest candidates kept in a frame: in dense scans of furnished rooms a list of 80 left out
  /// the heads of people in plain sight.
  int max_candidates = 120;
};

/// The trained classifiers (classifiers/head_classifier.hpp).
struct ClassifierParams {
  /// Lowest log odds, by the depths around it, of a candidate that is grown. Low: the cluster tells
  /// more.
  float min_head_odds = -1.0F;
  /// The same of a panorama's candidates, which lose `panorama_odds`. With -3 and -4 one person
  /// more at most is found in 180 simulated scans.
  float min_panorama_head_odds = -2.0F;
  /// Log odds that each candidate of a panorama gains: the classifier was trained on panoramas of
  /// 150 pixels a radian, and (230 / 150)^2 times as many places may look like a head by chance.
  /// Half of -ln 2.35, as pixels side by side see much the same: with all of it people of
  /// five_people are lost.
  float panorama_odds = -0.43F;
  /// Log odds by the same of a head that needs no cluster of a person's shape: people behind
  /// others, at the image's edge, on sofas.
  float sure_head_odds = 0.5F;
  /// Between this and a sure head's log odds the colour image is asked too, of so many candidates
  /// at most: each takes a look of the networks. From -2 on, and four of them, one of 80 simulated
  /// people up to 5.2 m away less is found.
  float min_asked_odds = -3.0F;
  int max_asked = 6;
  /// Lowest log odds of a skin-coloured part that the template does not take for a head.
  float min_skin_head_odds = 0.0F;
  /// Lowest log odds, by its cluster, of a person. Low: the fitted body tells more. With -1 one in
  /// twenty people of the real depth camera is lost, who sit on a sofa.
  float min_person_odds = -2.0F;
  /// Seeds nearer than this may be on one person's head and body [m]: head to elbow or breast.
  float rival_m = 0.60F;
  /// Log odds against two people whose heads are that near.
  float rival_odds = 1.0F;
  /// Candidates nearer than this to a likelier one are parts of the same head or its shoulders [m].
  float separation_m = 0.28F;
};

/// People whose head is out of sight (overlooked/hidden_heads.hpp).
struct HiddenHeadParams {
  /// Half as far as growing steps: a body must part from the one before it and from the wall.
  SurfaceParams surface = kPartedSurface;
  /// Surface of what is seen of such a body [m^2]: an arm and a leg beside somebody, a whole body
  /// without its head.
  float min_area_m2 = 0.05F, max_area_m2 = 0.7F;
  /// Its largest level side, and its least height [m]: trunk and a stretched arm; a leg or a trunk.
  float max_extent_m = 0.9F, min_height_m = 0.45F;
  /// Places that are tried for the head: heights over the ground, the likeliest (mean of adults)
  /// first, and distances across from the surface's middle [m].
  std::array<float, 5> head_heights_m = {1.60F, 1.50F, 1.70F, 1.40F, 1.80F};
  std::array<float, 7> across_m = {0.0F, -0.1F, 0.1F, -0.2F, 0.2F, -0.3F, 0.3F};
  /// The axis of a trunk lies this far behind its surface [m].
  float trunk_depth_m = 0.10F;
  /// A head's radius, and how much nearer somebody is who hides it [m].
  float head_radius_m = 0.09F, min_gap_m = 0.15F;
  /// Two people's axes are no nearer to one another [m]: half the width of a trunk and a half.
  float min_distance_m = 0.35F;
  /// Lowest log odds of a person who may hide another: behind furniture is no person.
  float min_hider_odds = 2.0F;
  /// Lowest mean log odds of the surface's points that it is a body's. With -0.6 three people of 35
  /// of stereo_dev/multi more have no segment; with -3 limbs of people beside it become people.
  float min_body_odds = -2.0F;
  /// Log odds of a person added for such a place: with the limits above all of 12 such surfaces
  /// were people's (simulated groups of seed 401 and stereo_dev/multi).
  float place_odds = 3.0F;
  // Where the colour image is asked (the pose network, in a square around the head's guess), the
  // head may be in sight too, and less of the body.
  /// Least height of the surface [m], and lowest mean log odds of its points.
  float min_part_height_m = 0.3F, min_part_odds = -2.5F;
  /// Higher surfaces show a shoulder or the head itself [m]: the head is guessed at their top.
  float min_shoulder_m = 1.25F;
  /// The largest surfaces only: each takes a look of the networks.
  int max_asked = 4;
  /// Log odds that it is a body's: `base` + `depth_odds` times those of its points + `score_odds`
  /// times those of the network's score, up to `max_score_odds`, + `joint_odds` times the joints in
  /// sight. Logistic regression on 804 surfaces of 440 simulated frames of groups and rooms: 69 of
  /// 92 that are bodies' are over -1 and 39 of 712 others; by the depths, where the head would be
  /// out of sight, 36 and 101.
  float base_odds = -3.6F, depth_odds = 0.87F, score_odds = 0.5F, joint_odds = 0.4F;
  float max_score_odds = 4.0F;
  float min_seen_odds = -1.0F;
};

/// People whose heads the depths around them do not tell, told by the whole body
/// (overlooked/overlooked.hpp).
struct OverlookedParams {
  /// Lowest log odds and score of the template (0 to 2.48) of a candidate that is asked about, how
  /// far from people who were found and from likelier ones it must be [m], and of how many a frame:
  /// each takes a look of the network.
  float min_head_odds = -8.0F, min_template_score = 1.6F, min_distance_m = 0.42F,
        separation_m = 0.4F;
  int max_asked = 8;
  /// Lowest log odds of a person, of the network of depths, and how much lower they may be where
  /// the head's place is a guess yet.
  float min_person_odds = 4.0F, guess_costs_odds = 3.0F;
  /// Where the network sees the head so far from what was asked about [m], that may be a back: it
  /// is asked once more from there.
  float min_moved_m = 0.2F;
  /// A head that was found so, and one of lower log odds than this, must be in sight (0 to 1): of
  /// somebody of whom the image shows a leg alone it is not (0.2), nor of a bush (0.37).
  float min_unseen_head_odds = -6.0F, min_head_visibility = 0.5F;
  /// A head that the depths around it nearly tell (log odds) needs less, where the network marks it
  /// so near [m]. A man before a wall has -1.5 to 0, 3.0 to 4.0 and 0.05 m in six of eight pictures
  /// of a real depth camera; of the other candidates there none has over -2.
  float min_likely_head_odds = -2.0F, min_likely_person_odds = 2.5F, max_likely_error_m = 0.1F;
  /// Log odds of such a head: sure, as by `HiddenHeadParams::place_odds`.
  float head_odds = 3.0F;
  // Candidates that were taken for parts of somebody beside them: hands and chests, and heads of
  // people who touch.
  /// Lowest log odds of one, and how far from the heads that were found, across the line of
  /// sight [m].
  float min_merged_odds = -1.0F, min_merged_distance_m = 0.2F;
  /// Lowest log odds of a person, of the network, and how far off it may mark the head [m]: of
  /// hands and chests it marks the head where that is, 0.2 m off or more. Of 982 simulated
  /// people in groups three more are found so, and no report more is wrong
  /// (tests/accuracy/README.md).
  float min_merged_person_odds = 5.0F, max_merged_error_m = 0.15F;
};

/// Surfaces that are shown to the network of depths, which tells bodies whose heads are in sight:
/// also smaller and larger ones than where less tells. Of 1334 simulated people in ten sets twelve
/// to fourteen more are found than without; with a least area of 0.08 m^2, a least height of 0.45 m
/// and four of them six fewer (tests/accuracy/README.md).
inline constexpr HiddenHeadParams kOverlookedBodies = [] {
  HiddenHeadParams params;
  params.min_area_m2 = 0.04F;
  params.max_area_m2 = 1.3F;
  params.max_extent_m = 1.4F;
  params.min_part_odds = -3.0F;
  // Their heads are in sight: at the top of a child or of somebody who sits, too.
  params.min_shoulder_m = 0.0F;
  params.max_asked = 8;
  return params;
}();

/// The four filters of section III-B.2. The defaults are those of `growing = refined`: loose, since
/// its classifiers judge too, and its clusters may be a head and a shoulder behind somebody else.
struct FilterParams {
  /// Smallest and largest visible surface of a person [m^2], counted in points of the sensor at the
  /// cluster's distance.
  float min_area_m2 = 0.03F;
  float max_area_m2 = 2.2F;
  /// How far the seed must stand over the cluster's centroid along gravity, and how far at most
  /// beside it [m]; the latter is the reach of a human: all there is.
  float min_seed_over_centroid_m = 0.03F;
  float max_seed_beside_centroid_m = 1.0F;
  /// Share of the sensor's rays through the cluster's outline that must have hit it.
  float min_density = 0.25F;
};

/// The same of `growing = paper`, where nothing else judges. Clusters grown from the true heads of
/// stereo_dev/general and pointing (58, floor and furniture in reach included) measure 0.33 to 1.9
/// m^2, 0.31 to 1.4 m over the centroid, up to 0.31 m beside it, density 0.68 to 1: limits a tenth
/// outside. Of 4985 false seeds there and in nohuman these filters reject 91 %, the loose ones 56
/// %.
inline constexpr FilterParams kPaperFilters{0.30F, 2.1F, 0.28F, 0.33F, 0.62F};

/// Skin-coloured parts.
struct SkinParams {
  /// Log of the likelihood ratio above which a colour is skin (Jones and Rehg 2002).
  float min_log_ratio = 0.0F;
  /// Surface of a part that may be a face or a hand [m^2].
  float min_area_m2 = 0.004F, max_area_m2 = 0.12F;
  /// Fewest points of a part in the thinned lattice.
  int min_points = 8;
  /// Depth step that parts two skin-coloured surfaces [m].
  float max_step_m = 0.08F;
};

/// The virtual image of a cloud without a camera.
struct PanoramaParams {
  /// Pixels a radian. With 150, heads at 4 m are 8 pixels large and some are lost (laser_dev).
  float focal_px = 230.0F;
  /// Beams of a scanner stand up to twice this apart [px]: 3 degrees.
  int gap_px = 6;
};

struct Params {
  SeedSource seeds = SeedSource::kAuto;
  Growing growing = Growing::kRefined;
  SearchStructure search = SearchStructure::kAuto;
  GroundParams ground;
  ReachParams reach;
  PaperGrowingParams paper;
  JointGrowingParams joint;
  FurnitureParams furniture;
  BodyCutParams body_cut;
  HeadShapeParams head;
  ClassifierParams classifier;
  HiddenHeadParams hidden_heads;
  OverlookedParams overlooked;
  HiddenHeadParams overlooked_bodies = kOverlookedBodies;
  LostArmParams lost_arms;
  SplitBodyParams split_bodies;
  FloatingArmParams floating_arms;
  FloatingArmParams floating_arms_beside_image = kFloatingArmsBesideImage;
  FilterParams filters;
  FilterParams paper_filters = kPaperFilters;
  SkinParams skin;
  PanoramaParams panorama;
  /// Range image around a person of a cloud without a camera. Coarser than the panorama: between
  /// the points of a thin limb the fitter must not see through it.
  PanoramaParams scan_range_image{150.0F, 4};
  FaceParams faces;
  PoseNetworkParams pose_network;
  PoseNetworkParams second_pose_network = kSecondPoseNetwork;
  DepthPoseParams depth_pose;
  /// Space kept around a cluster in its range image [m].
  float range_image_margin_m = 0.15F;
};

}  // namespace limbcast::segmenter
