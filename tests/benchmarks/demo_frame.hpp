#pragma once

#include "common/camera/images.hpp"
#include "common/cloud/cloud.hpp"

namespace limbcast::test {

/// The first frame of the demo log: its images and the cloud made from them.
struct DemoFrame {
  StereoImages images;
  Cloud cloud;
};

/// Read once.
const DemoFrame& demo_frame();

}  // namespace limbcast::test
