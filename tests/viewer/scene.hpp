#pragma once

#include "modules/viewer/view_frame.hpp"

namespace limbcast::viewer {

/// A grey wall 4 m away, seen by a camera of 160 x 120 pixels.
inline Cloud wall(std::int64_t utime_us = 0) {
  Cloud cloud;
  cloud.stamp.utime = utime_us;
  cloud.stamp.sensor = "front";
  cloud.width = 160;
  cloud.height = 120;
  cloud.camera = PinholeCamera{160, 120, 120.0, 120.0, 80.0, 60.0};
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u)
      cloud.points_m.push_back(
          cloud.camera->back_project(static_cast<float>(u), static_cast<float>(v), 4.0F));
  }
  cloud.colors.assign(cloud.points_m.size(), Bgr{90, 90, 90});
  return cloud;
}

/// One person of whom only the right arm is known; it is stretched out to the image's left, 3 m
/// away, and points there.
inline BodyPoses pointing_arm(std::int64_t utime_us = 0) {
  BodyPoses poses;
  poses.stamp.utime = utime_us;
  poses.stamp.sensor = "front";
  BodyPose person;
  person[Joint::kShoulderRight].position_m = {1.0F, 0.0F, 3.0F};
  person[Joint::kElbowRight].position_m = {0.5F, 0.0F, 3.0F};
  person[Joint::kWristRight].position_m = {0.0F, 0.0F, 3.0F};
  for (const Joint joint : {Joint::kShoulderRight, Joint::kElbowRight, Joint::kWristRight})
    person[joint].valid = true;
  Pointing arm;
  arm.side = Side::kRight;
  arm.direction = arm.forearm = -Eigen::Vector3f::UnitX();
  person.pointing.push_back(arm);
  poses.persons.push_back(person);
  return poses;
}

}  // namespace limbcast::viewer
