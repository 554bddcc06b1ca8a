#include "common/sources/video_source.hpp"

#include <cmath>
#include <utility>

#include "common/input_file.hpp"
#include "common/sources/ffmpeg_video.hpp"

namespace limbcast {
namespace {

void open_video(cv::VideoCapture& video, const std::string& path) {
  check_is_file(path, "give a video file");
  open_by_ffmpeg(video, path, "give a video file, an LCM log, a folder of pictures or a camera");
}

}  // namespace

VideoSource::VideoSource(std::string first_path, std::string second_path, PairFormat format,
                         const VideoParams& params)
    : first_path_(std::move(first_path)),
      second_path_(std::move(second_path)),
      format_(std::move(format)),
      params_(params) {
  open();
  rate_hz_ = params_.rate_hz > 0.0 ? params_.rate_hz : first_video_.get(cv::CAP_PROP_FPS);
  if (!(rate_hz_ > 0.0)) throw InputError(first_path_ + ": tells no frame rate; give --rate");
}

void VideoSource::open() {
  open_video(first_video_, first_path_);
  if (!second_path_.empty()) open_video(second_video_, second_path_);
}

bool VideoSource::read(cv::Mat& first, cv::Mat& second) {
  if (!first_video_.read(first)) return false;
  if (!second_path_.empty()) return second_video_.read(second);
  std::tie(first, second) = split_side_by_side(first, first_path_);
  return true;
}

std::optional<FramePair> VideoSource::next() {
  if (ended_) return std::nullopt;
  cv::Mat first;
  cv::Mat second;
  bool has_frame = read(first, second);
  if (!has_frame && params_.loop && sequence_ > 0) {
    open();
    has_frame = read(first, second);
  }
  if (!has_frame) {
    ended_ = true;
    if (sequence_ == 0) throw InputError(first_path_ + ": holds no picture; record it again");
    return std::nullopt;
  }
  FramePair frame;
  frame.first = coded_for_sending(first, format_.jpeg_quality);
  frame.second = coded_for_sending(second, format_.jpeg_quality);
  check_pair(format_, frame.first, frame.second, first_path_);
  frame.stamp.utime =
      params_.start_utime + std::llround(1e6 * static_cast<double>(sequence_) / rate_hz_);
  frame.stamp.sequence = sequence_++;
  frame.stamp.sensor = format_.sensor;
  frame.stamp.frame = format_.frame;
  return frame;
}

std::string VideoSource::description() const {
  const std::string files =
      second_path_.empty() ? first_path_ + " (side by side)" : first_path_ + " and " + second_path_;
  return files + ": video, " + std::to_string(rate_hz_) + " frames/s";
}

std::pair<cv::Mat, cv::Mat> split_side_by_side(const cv::Mat& both, const std::string& where) {
  if (both.cols % 2 != 0) {
    throw InputError(
        where + ": pictures of width " + std::to_string(both.cols) +
        " do not hold two cameras side by side; give the right one with --source-right");
  }
  const int half = both.cols / 2;
  return {both.colRange(0, half), both.colRange(half, both.cols)};
}

}  // namespace limbcast
