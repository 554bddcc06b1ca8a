#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/camera/calibration.hpp"
#include "common/camera/encoded_image.hpp"
#include "common/camera/recording.hpp"
#include "common/cloud/cloud.hpp"
#include "common/human_model/body_pose.hpp"
#include "common/sources/frame_source.hpp"

namespace limbcast {

/// What a sensor that takes two images at once gives: left and right, or colour and depth.
struct FramePair {
  Stamp stamp;
  EncodedImage first, second;      ///< first: empty of a depth camera without colour
  std::optional<BodyPoses> truth;  ///< where a recording holds it
  /// For errors: the file of a folder.
  std::string second_name = "second image";
};

/// How the two images of a sensor are named and must look.
struct PairFormat {
  FilePair names;                ///< {"left", "right"} or {"color", "depth"}
  bool second_is_depth = false;  ///< 16 bit, kept without loss
  int width = 0, height = 0;     ///< size that the calibration is for [px]; 0: any
  std::string sensor;            ///< Stamp::sensor
  std::string frame;             ///< Stamp::frame
  int jpeg_quality = 95;  ///< of pictures that are no JPEG yet, 1 to 100; 0: PNG, without loss
  int second_width = 0, second_height = 0;  ///< of the second image [px]; 0: as the first
  bool first_is_optional = false;           ///< a depth camera may have no colour camera beside it
};

using PairSource = FrameSource<FramePair>;

/// Checks that both pictures have the size of the calibration and the kind that the sensor gives;
/// an empty one that may be absent has none. `where` names them in errors.
void check_pair(const PairFormat& format, const EncodedImage& first, const EncodedImage& second,
                const std::string& where);

/// The image as it is sent: JPEG as it is, others coded as `jpeg_quality` says.
EncodedImage coded_for_sending(EncodedImage image, int jpeg_quality, const std::string& where);
/// Same for pixels.
EncodedImage coded_for_sending(const cv::Mat& pixels, int jpeg_quality);

/// Gravity and height of a frame: what the user's option says, else the recording, else the
/// calibration.
void apply_mounting(const Mounting& option, const Mounting& calibration, Gravity& gravity);

}  // namespace limbcast
