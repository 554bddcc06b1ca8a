#pragma once

#include <Eigen/Core>
#include <limits>
#include <opencv2/core.hpp>

#include "modules/segmenter/networks/tflite_network.hpp"

namespace limbcast::segmenter {

/// What may be a face in a picture.
struct SeenFace {
  /// The higher, the likelier it is one; the network's own number, in which hidden faces count too.
  float score = -std::numeric_limits<float>::infinity();
  Eigen::Vector2f nose_px = Eigen::Vector2f::Zero();  ///< its tip, in the picture
  Eigen::Vector2f ears_px = Eigen::Vector2f::Zero();  ///< the middle between both
};

/// BlazeFace, full range (V. Bazarevsky et al., "BlazeFace: Sub-millisecond Neural Face Detection
/// on Mobile GPUs", CVPR workshop 2019; ../models/README.md): faces and the marks on them. For one
/// thread at a time.
class BlazeFace {
 public:
  /// Side of the square picture that it takes [px].
  static constexpr int kPictureSide_px = 192;

  /// A file that is part of the program; the same at each call.
  static const TfliteFile& file();

  explicit BlazeFace(NetworkLibrary library = network_libraries().front());

  /// The likeliest face whose middle is at most `reach_px` from the picture's middle. The picture:
  /// the face upright; blue, green and red.
  SeenFace see(const cv::Mat3b& picture, float reach_px);

 private:
  TfliteNetwork network_;
};

}  // namespace limbcast::segmenter
