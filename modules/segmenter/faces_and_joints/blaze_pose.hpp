#pragma once

#include "modules/segmenter/faces_and_joints/picture_network.hpp"
#include "modules/segmenter/networks/tflite_network.hpp"

namespace limbcast::segmenter {

/// BlazePose (V. Bazarevsky et al., "BlazePose: On-device Real-time Body Pose tracking", CVPR
/// workshop 2020; ../models/README.md): joints, how far behind the hips they are, and whether a
/// person is there.
class BlazePose : public PictureNetwork {
 public:
  /// A file that is part of the program; the same at each call.
  static const TfliteFile& file();

  explicit BlazePose(NetworkLibrary library = network_libraries().front());
  ImagePose see(const cv::Mat3b& picture) override;

 private:
  TfliteNetwork network_;
};

}  // namespace limbcast::segmenter
