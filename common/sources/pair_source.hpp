#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/camera/calibration.hpp"
#include "common/camera/encoded_image.hpp"
#include "common/camera/recording.hpp"
#include "common/cloud/cloud.hpp"
#include "common/human_model/body_pose.hpp"

namespace limbcast {

/// What a sensor that takes two images at once gives: left and right, or colour and depth.
struct FramePair {
  Stamp stamp;
  EncodedImage first, second;
  std::optional<BodyPoses> truth;  ///< where a recording holds it
};

/// How the two images of a sensor are named and must look.
struct PairFormat {
  FilePair names;                ///< {"left", "right"} or {"color", "depth"}
  bool second_is_depth = false;  ///< 16 bit, kept without loss
  int width = 0, height = 0;     ///< size that the calibration is for [px]
  std::string sensor;            ///< Stamp::sensor
  std::string frame;             ///< Stamp::frame
  int jpeg_quality = 95;  ///< of pictures that are no JPEG yet, 1 to 100; 0: PNG, without loss
};

/// Counted since the start.
struct SourceStatistics {
  std::int64_t dropped = 0;   ///< live frames that a newer one replaced before they were taken
  std::int64_t unpaired = 0;  ///< live frames of one camera without a partner in time
  std::int64_t reopened = 0;  ///< times that a camera was opened again
  std::string problem;        ///< what is wrong now, empty = nothing
};

/// Where frames come from: a recording, a video, cameras.
class PairSource {
 public:
  PairSource() = default;
  virtual ~PairSource() = default;
  PairSource(const PairSource&) = delete;
  PairSource& operator=(const PairSource&) = delete;

  /// The next frame. Nothing: at the end, or where a live source had none within 100 ms. Throws
  /// InputError for a frame that cannot be used.
  virtual std::optional<FramePair> next() = 0;
  virtual bool ended() const = 0;
  /// Live: frames come when the camera gives them. Else: as fast as they are asked for.
  virtual bool live() const = 0;
  virtual SourceStatistics statistics() const { return {}; }
  /// For the log at start: what it is, how many frames.
  virtual std::string description() const = 0;
};

/// Checks that both pictures have the size of the calibration and the kind that the sensor gives.
/// `where` names them in errors.
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
