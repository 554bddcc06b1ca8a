#pragma once

#include <opencv2/core.hpp>

#include "common/cloud/segment.hpp"

namespace limbcast::segmenter {

/// Side of the square picture that the networks of poses take [px].
constexpr int kPictureSide_px = 256;

/// Networks that see one person's joints in a picture.
enum class PictureNetworkKind {
  kBlazePose,  ///< blaze_pose.hpp
  kMoveNet     ///< move_net.hpp
};

/// A joint and its place among what a network tells.
struct JointOutput {
  Joint joint;
  int index;
};

/// Writes a picture's red, green and blue as `scale` times them plus `shift`, as a network takes
/// them.
void write_rgb(const cv::Mat3b& picture, double scale, double shift, float* input);

/// Sees one person's joints in a picture; for one thread at a time.
class PictureNetwork {
 public:
  PictureNetwork() = default;
  virtual ~PictureNetwork() = default;
  PictureNetwork(const PictureNetwork&) = delete;
  PictureNetwork& operator=(const PictureNetwork&) = delete;

  /// Joints in the picture's pixels. The picture: the person upright, blue, green and red, black
  /// beyond the image.
  virtual ImagePose see(const cv::Mat3b& picture) = 0;
};

}  // namespace limbcast::segmenter
