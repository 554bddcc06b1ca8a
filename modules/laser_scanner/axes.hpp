#pragma once

#include <Eigen/Core>
#include <string>

namespace limbcast::laser_scanner {

/// Axes of a sensor's frame against ours (x right, y down, z forward), with the length unit.
class Axes {
 public:
  /// `text` says which of the sensor's axes point right, down and forward: "x,y,z" is our own
  /// frame,
  /// "-y,-z,x" one with x forward, y left, z up (ROS, KITTI, Ouster), "x,-z,y" Velodyne's own.
  /// `unit_m`: metres for one unit. Throws InputError for a text that names no right-handed frame.
  Axes(const std::string& text, double unit_m);

  Eigen::Vector3f operator()(const Eigen::Vector3f& sensor_point) const {
    return metres_from_sensor_ * sensor_point;
  }

 private:
  Eigen::Matrix3f metres_from_sensor_;
};

}  // namespace limbcast::laser_scanner
