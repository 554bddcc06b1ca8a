#pragma once

#include <random>

#include "common/cloud/cloud.hpp"

/// Values that the tests of several codecs send.
namespace limbcast::lcm_io {

inline Stamp test_stamp() {
  Stamp stamp;
  stamp.utime = 1768870000000000;
  stamp.sequence = 42;
  stamp.sensor = "front";
  stamp.frame = "front/left_rectified";
  stamp.gravity.down = Eigen::Vector3f(0.0F, 0.8F, 0.6F);
  stamp.gravity.source = GravitySource::kRecording;
  stamp.gravity.sensor_height_m = 1.2F;
  // 0.15 px of a camera with 520.6 px focal length and 0.12 m baseline.
  stamp.depth_noise = {0.0F, 0.15F / (520.6F * 0.12F)};
  return stamp;
}

inline Cloud camera_cloud() {
  Cloud cloud;
  cloud.stamp = test_stamp();
  cloud.width = 40;
  cloud.height = 30;
  cloud.camera = PinholeCamera{40, 30, 50.0, 50.0, 19.5, 14.5};
  std::mt19937 random(3);
  std::uniform_real_distribution<float> depth(0.5F, 9.0F);
  for (int v = 0; v < cloud.height; ++v)
    for (int u = 0; u < cloud.width; ++u)
      cloud.points_m.push_back(cloud.camera->back_project(
          static_cast<float>(u), static_cast<float>(v), u == v ? 0.0F : depth(random)));
  cloud.colors.assign(cloud.points_m.size(), Bgr{30, 60, 200});
  return cloud;
}

}  // namespace limbcast::lcm_io
