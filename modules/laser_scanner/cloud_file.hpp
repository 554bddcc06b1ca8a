#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/cloud/cloud.hpp"

namespace limbcast::laser_scanner {

/// Points as a file or a scanner gives them, in the sensor's axes and unit; all finite.
struct RawCloud {
  std::vector<Eigen::Vector3f> points;
  // Each of these is empty, or holds one for each point.
  std::vector<Bgr> colors;
  std::vector<float> intensities;  ///< in the file's or scanner's unit; 0 where not finite
  std::vector<std::uint16_t> rings;
};

/// Reads .pcd (ascii, binary, binary_compressed), .ply (ascii, binary little-endian) or .bin
/// (KITTI: x y z intensity, 32-bit floats), with the columns of colours, intensities and rings that
/// there are. Points that are not finite (no return) are left out.
/// Throws InputError naming file and fault; more than `max_points` are one.
RawCloud read_cloud_file(const std::string& path, std::size_t max_points);

}  // namespace limbcast::laser_scanner
