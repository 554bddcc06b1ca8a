#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/camera/pinhole_camera.hpp"

namespace limbcast {

/// Who told the direction of gravity; later ones are trusted less.
enum class GravitySource : std::int8_t {
  kRecording = 0,    ///< timestamps.csv of a recording, an inertial unit, or ground truth
  kOption = 1,       ///< the user's option or the mounting in the calibration file
  kGroundPlane = 2,  ///< the ground plane found in the cloud
  kLevel = 3,        ///< nobody: the sensor is taken to be level
};

/// Direction of gravity and place of the sensor over the ground.
struct Gravity {
  Eigen::Vector3f down{0.0F, 1.0F, 0.0F};  ///< unit vector in the sensor's frame
  GravitySource source = GravitySource::kLevel;
  /// Height of the sensor's origin over the ground [m], where it is known.
  std::optional<float> sensor_height_m;
};

/// Standard deviation of a measured distance along the ray: constant_m + quadratic_per_m * z^2 [m].
/// Stereo: quadratic_per_m = sigma_disparity / (focal length * baseline), from differentiating
/// z = f * B / d.
struct DepthNoise {
  float constant_m = 0.0F;
  float quadratic_per_m = 0.0F;
  float sigma_m(float z_m) const { return constant_m + quadratic_per_m * z_m * z_m; }
  /// A camera's does, where neighbouring points share their errors; a range finder's does not.
  bool grows_with_distance() const { return quadratic_per_m > 0.0F; }
};

/// What stays the same from the capture to the pose: who saw it, when, and how the sensor stood.
struct Stamp {
  std::int64_t utime = 0;     ///< moment of capture [us since the Unix epoch]
  std::int64_t sequence = 0;  ///< counts up by one with each message of its publisher
  std::string sensor;         ///< name of the sensor, e.g. "front"
  std::string frame;          ///< frame of all points, e.g. "front/left_rectified"
  Gravity gravity;
  DepthNoise depth_noise;
};

struct Bgr {
  std::uint8_t b = 0, g = 0, r = 0;
};

/// Points that one sensor saw at one instant, in Stamp::frame (x right, y down, z forward).
///
/// Organised by a camera (`camera` is set): point (u, v) stands at index v * width + u and lies on
/// the ray of pixel (u, v); a hole has z = 0 (and x = y = 0). Unorganised: height = 1, no holes.
struct Cloud {
  Stamp stamp;
  int width = 0, height = 0;
  std::optional<PinholeCamera> camera;
  std::vector<Eigen::Vector3f> points_m;  ///< width * height of them; finite
  // Each of these is empty, or holds one for each point (holes of a camera's cloud too).
  std::vector<Bgr> colors;
  std::vector<float> intensities;  ///< how strongly the light came back [the sensor's unit]; finite
  std::vector<std::uint16_t> rings;  ///< number of the laser that measured the point

  bool organized() const { return camera.has_value(); }
  bool is_hole(std::size_t index) const { return camera && points_m[index].z() <= 0.0F; }
};

}  // namespace limbcast
