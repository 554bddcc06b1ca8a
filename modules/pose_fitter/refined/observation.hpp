#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "common/cloud/segment.hpp"
#include "modules/pose_fitter/refined/body_model.hpp"
#include "modules/pose_fitter/refined/refined_params.hpp"

namespace limbcast::pose_fitter::refined {

/// Points in columns, so that several are worked on at once: memory reaches to a whole vector of
/// eight.
struct PointColumns {
  std::vector<float> x, y, z;  ///< [m]
  std::vector<float> weight;   ///< area that the point stands for / 9 cm^2, times a point's weight
  std::vector<float> sigma_m;  ///< of the distance along the ray

  std::size_t size() const { return weight.size(); }
  void add(const Vec3& point, float point_weight, float point_sigma_m);
  void pad();  ///< must follow the last add
};

/// A joint as the image shows it, in the range image's frame.
struct SeenJoint {
  Vec3 ray = Vec3::UnitZ();    ///< unit vector from the camera towards it
  Real visibility = 0.0;       ///< 0 to 1, as it counts in the fit; 0: not told
  Real behind_hips_m = 0.0;    ///< how much farther away than the hips' middle; rough
  Real told_visibility = 0.0;  ///< how sure the network is that it is in sight, 0 to 1
  Real spread = 1.0;           ///< how unsure the mark's place is, 1: as usual with this network
};

/// A person as one of them sees it.
struct ImageLook {
  ImageNetwork network = ImageNetwork::kBlazePose;
  Real weight = 0.0;        ///< of its joints against the surface
  Real depth_weight = 0.0;  ///< of the depths it tells
  Real person_score = 0.0;  ///< how sure the network is of a person, 0 to 1
  std::array<SeenJoint, kJointCount> joints;
};

/// Column and row; they may lie beside the image.
struct Pixel {
  int u, v;
};

/// What the sensor saw of one person, made ready for many looks, in the range image's frame.
struct Observation {
  PointColumns fine, coarse;  ///< coarse: a quarter of the points

  PinholeCamera camera;  ///< of the grids below
  int origin_u = 0, origin_v = 0, full_width = 0,
      full_height = 0;  ///< place in the sensor's image [px]
  /// Distance to where the sensor saw through [px]: positive where a body may stand, negative
  /// outside.
  std::vector<float> clearance_px;
  std::vector<float> surface_m;   ///< the person's own surface along the optical axis, 0 = none
  std::vector<float> seen_m;      ///< the same with whatever stands before the person
  std::vector<float> measured_m;  ///< the same with all that was measured
  /// Distance to the nearest skin-coloured pixel of the person [px]; empty where none is known.
  std::vector<float> skin_distance_px;
  DepthNoise noise;

  FaceEvidence face;             ///< what its face tells
  std::vector<ImageLook> looks;  ///< of the networks that looked
  bool has_colors = false;
  Vec3 up;                         ///< against gravity
  Vec3 head_start;                 ///< first guess of the head's centre
  Real head_start_sigma_m = 0.05;  ///< standard deviation of its error
  bool guessed_head = false;       ///< the segment began at a body whose head is out of sight
  std::optional<Real> floor_m;     ///< place of the floor along -up, where it is known
  Eigen::Matrix3f frame_from_image = Eigen::Matrix3f::Identity();

  /// That shows `point`, whose z must be positive.
  Pixel pixel_of(const Vec3& point) const {
    return {static_cast<int>(std::lround(camera.fx * point.x() / point.z() + camera.cx)),
            static_cast<int>(std::lround(camera.fy * point.y() / point.z() + camera.cy))};
  }
  bool inside(int u, int v) const {
    return u >= 0 && v >= 0 && u < camera.width && v < camera.height;
  }
  /// In the sensor's own image, the crop's pixels given: beyond it nothing is known.
  bool in_sensor_image(int u, int v) const {
    const int full_u = u + origin_u, full_v = v + origin_v;
    return full_u >= 0 && full_v >= 0 && full_u < full_width && full_v < full_height;
  }
  /// The surface at a pixel, averaged with its neighbours of about the same depth.
  float smooth_surface_m(int u, int v) const;
  /// The same at the pixel where a network sees a joint; 0 = none.
  float smooth_surface_m(const SeenJoint& seen) const;
  std::size_t at(int u, int v) const { return static_cast<std::size_t>(v) * camera.width + u; }
};

/// Nothing when there are too few points for a person.
std::optional<Observation> observe(const Segment& segment, const Stamp& stamp,
                                   const RefinedParams& params);

}  // namespace limbcast::pose_fitter::refined
