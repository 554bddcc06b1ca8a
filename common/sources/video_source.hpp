#pragma once

#include <opencv2/videoio.hpp>

#include "common/sources/pair_source.hpp"

namespace limbcast {

struct VideoParams {
  double rate_hz = 0.0;          ///< frames a second; 0: as the file says
  std::int64_t start_utime = 0;  ///< of the first frame [us]
  bool loop = false;  ///< start again at the end; times and sequence numbers go on rising
};

/// A video file with left and right side by side in each picture, or one file for each camera.
class VideoSource : public PairSource {
 public:
  /// `second_path` empty: side by side.
  VideoSource(std::string first_path, std::string second_path, PairFormat format,
              const VideoParams& params);

  std::optional<FramePair> next() override;
  bool ended() const override { return ended_; }
  bool live() const override { return false; }
  std::string description() const override;

 private:
  void open();
  bool read(cv::Mat& first, cv::Mat& second);

  std::string first_path_, second_path_;
  PairFormat format_;
  VideoParams params_;
  cv::VideoCapture first_video_, second_video_;
  double rate_hz_ = 0.0;
  bool ended_ = false;
  std::int64_t sequence_ = 0;
};

/// Left and right halves of a picture that holds both cameras side by side. Throws InputError where
/// its width is odd.
std::pair<cv::Mat, cv::Mat> split_side_by_side(const cv::Mat& both, const std::string& where);

}  // namespace limbcast
