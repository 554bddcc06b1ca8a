#pragma once

#include "common/camera/images.hpp"
#include "common/cloud/cloud.hpp"
#include "common/human_model/body_pose.hpp"

namespace limbcast::test {

/// The first frame of the demo log: its images, the cloud made from them, and the truth.
struct DemoFrame {
  StereoImages images;
  Cloud cloud;
  BodyPoses truth;
};

/// Read once.
const DemoFrame& demo_frame();

}  // namespace limbcast::test
