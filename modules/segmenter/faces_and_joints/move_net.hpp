#pragma once

#include <Eigen/Core>
#include <optional>

#include "modules/segmenter/faces_and_joints/picture_network.hpp"
#include "modules/segmenter/networks/tflite_network.hpp"

namespace limbcast::segmenter {

/// MoveNet SinglePose Thunder (R. Votel and N. Li, "Next-Generation Pose Detection with MoveNet and
/// TensorFlow.js", 2021; ../models/README.md): joints as peaks of maps, without depths. It errs at
/// other people than BlazePose, and marks joints nearer to where they are.
class MoveNet : public PictureNetwork {
 public:
  /// A file that is part of the program; the same at each call.
  static const TfliteFile& file();

  explicit MoveNet(NetworkLibrary library = network_libraries().front());
  ImagePose see(const cv::Mat3b& picture) override;

 private:
  struct Keypoint {
    Eigen::Vector2f px;  ///< of the picture
    float score;         ///< 0 to 1
  };

  /// The cell of the person in the picture's middle.
  int find_person() const;
  Keypoint find_keypoint(int person_cell, int keypoint) const;

  TfliteNetwork network_;
};

}  // namespace limbcast::segmenter
