#pragma once

#include <utility>

#include "common/cloud/cloud.hpp"

/// What a camera sees that is turned by a quarter about its optical axis: "down" is its x.
namespace limbcast::segmenter {

inline Eigen::Vector3f turned(const Eigen::Vector3f& upright) {
  return {upright.y(), -upright.x(), upright.z()};
}

inline Cloud turned(const Cloud& upright) {
  Cloud cloud = upright;
  std::swap(cloud.width, cloud.height);
  PinholeCamera& camera = *cloud.camera;
  std::swap(camera.width, camera.height);
  std::swap(camera.fx, camera.fy);
  camera.cx = upright.camera->cy;
  camera.cy = upright.width - 1 - upright.camera->cx;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const int to = v * cloud.width + u;
      const int from = u * upright.width + upright.width - 1 - v;
      cloud.points_m[to] = turned(upright.points_m[from]);
      cloud.colors[to] = upright.colors[from];
    }
  }
  cloud.stamp.gravity.down = turned(upright.stamp.gravity.down);
  return cloud;
}

}  // namespace limbcast::segmenter
