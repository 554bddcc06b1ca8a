#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "common/cloud/cloud.hpp"

namespace limbcast::laser_scanner {

/// Points as a file or a scanner gives them, in the sensor's axes and unit; all finite.
struct RawCloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<Bgr> colors;  ///< empty, or one for each point
};

/// Reads .pcd (ascii, binary, binary_compressed), .ply (ascii, binary little-endian) or .bin
/// (KITTI: x y z intensity, 32-bit floats). Points that are not finite (no return) are left out.
/// Throws InputError naming file and fault.
RawCloud read_cloud_file(const std::string& path);

}  // namespace limbcast::laser_scanner
