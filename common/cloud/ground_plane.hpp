#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "common/cloud/cloud.hpp"

namespace limbcast {

/// What counts as the ground, and how hard to look for it.
struct GroundPlaneParams {
  /// The ground's normal is at most this far from the assumed direction of gravity [rad] (40
  /// degrees: a camera pitched towards the floor of a room, while the walls stay out).
  double max_tilt_rad = 0.70;
  /// Heights of the sensor over the ground that are believed [m].
  double min_height_m = 0.25;
  double max_height_m = 4.0;
  /// Distance to the plane that still counts as ground [m]; two sigma of the depth noise are added.
  double inlier_distance_m = 0.03;
  /// Points farther away say nothing of the ground [m]: streets slope and have kerbs, and who is
  /// found stands within 8 m. Of nine real scans of streets and yards three show a plane with
  /// points up to 30 m away, eight with those up to 10 m.
  double max_distance_m = 10.0;
  /// The plane must hold at least this share of those points (a frame filled by one person shows
  /// about 5 % floor).
  double min_inlier_share = 0.04;
  /// At most this many points below the plane for one point on it: under the ground there is
  /// nothing, so a table or a shelf does not pass.
  double max_below_share = 0.10;
  /// Extent (standard deviation) of the ground's points in its narrower direction, at least [m].
  double min_extent_m = 0.12;
  /// Planes that extend less may have less below them, in proportion [m]; 0: all as much.
  double full_extent_m = 0.0;
  /// Draws of 3 points. 99 % success at 18 % ground: log(1 - 0.99) / log(1 - 0.18^3), Szeliski,
  /// Computer Vision (2010), Eq. (6.30).
  int ransac_iterations = 800;
  /// Draws where those find no ground: 99 % success at 8 %, as between parked cars.
  int hard_ransac_iterations = 8000;
  /// The cloud is thinned to about this many points.
  int sample_size = 2400;
};

/// What a plane must be that tells gravity itself: boards, beds and shelves make planes in rooms
/// whose floor is out of sight. Of 162 pairs of a real camera 106 had such a "ground", 0.26 to
/// 1.05 m below it, and none with these limits; of 198 simulated pairs 181 show the floor, and 180.
inline GroundPlaneParams where_gravity_is_untold() {
  GroundPlaneParams params;
  params.min_extent_m = 0.2;
  params.full_extent_m = 1.0;
  return params;
}

struct GroundPlane {
  Eigen::Vector3f down;       ///< unit normal of the ground, away from the sensor
  float height_m = 0.0F;      ///< of the sensor's origin over the plane
  float inlier_share = 0.0F;  ///< of the points that are near enough
  /// How clearly it is the ground, 0.5 to 1: the least of three figures, which are 0.5 where the
  /// plane only just passes: its share of the points, its extent, and how little lies below it.
  float confidence = 0.0F;
};

/// The plane that people stand on: below the sensor, within `max_tilt_rad` of `down`, with nothing
/// beneath. RANSAC (Fischler and Bolles 1981) with a fixed seed and a least squares fit of what it
/// found: the same cloud gives the same plane. Nothing where no plane is believable.
std::optional<GroundPlane> find_ground_plane(const Cloud& cloud, const Eigen::Vector3f& down,
                                             const GroundPlaneParams& params = {});

/// Completes `cloud.stamp.gravity` from the ground that the cloud shows.
///
/// Direction of gravity: stays where anybody told it; where nobody did (kLevel), the ground's
/// normal is taken (kGroundPlane) of a plane that passes `untold`, or, without one, it stays level.
/// Height of the sensor: where not known yet, the height along gravity over the ground's points.
/// Returns the ground that told either.
std::optional<GroundPlane> complete_gravity(
    Cloud& cloud, const GroundPlaneParams& untold = where_gravity_is_untold());

/// For a module's status: who told gravity, and how sure the ground is that told it or the height.
std::string describe(const Gravity& gravity, const std::optional<GroundPlane>& ground);

}  // namespace limbcast
