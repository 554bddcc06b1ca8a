#include "common/sources/video_reader.hpp"

#include <cmath>
#include <filesystem>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>

#include "common/input_error.hpp"
#include "common/sources/capture_time.hpp"
#include "common/sources/ffmpeg_video.hpp"
#include "common/sources/pipeline_reader.hpp"
#include "common/sources/v4l2_camera.hpp"
#include "common/sources/v4l2_device.hpp"

namespace limbcast {
namespace {

const std::string kPipelinePrefix = "gst:";

bool starts_with(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

/// A device that is unplugged is one too; what stands in /dev/shm is none.
bool is_device(const std::string& source) {
  std::error_code unreachable;
  const std::filesystem::file_status status = std::filesystem::status(source, unreachable);
  return starts_with(source, "/dev/") && !is_regular_file(status) && !is_directory(status);
}

class VideoReader : public FrameReader {
 public:
  explicit VideoReader(const cv::VideoCapture& capture) : capture_(capture) {}

  std::optional<CapturedFrame> read() override {
    cv::Mat pixels;
    if (!capture_.read(pixels) || pixels.empty()) return std::nullopt;
    // The capture reuses its buffer for the next frame.
    return CapturedFrame{read_clocks().utime, {pixels.clone()}};
  }

 private:
  cv::VideoCapture capture_;
};

cv::VideoCapture open_stream(const std::string& url) {
  cv::VideoCapture capture;
  open_by_ffmpeg(capture, url, "check its address, and whether it is sending");
  return capture;
}

}  // namespace

bool is_camera(const std::string& source) {
  return is_device(source) || starts_with(source, kPipelinePrefix) ||
         source.find("://") != std::string::npos;
}

std::string driver_settings(const CameraSettings& settings) {
  std::string names;
  const auto add = [&](bool wanted, const char* name) {
    if (wanted) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  add(settings.width > 0, "camera-width");
  add(settings.height > 0, "camera-height");
  add(settings.rate_hz > 0.0, "camera-rate");
  add(!settings.format.empty(), "camera-format");
  add(std::isfinite(settings.exposure), "exposure");
  add(std::isfinite(settings.gain), "gain");
  return names;
}

std::unique_ptr<FrameReader> open_camera(const std::string& source,
                                         const CameraSettings& settings) {
  // What OpenCV warns of is no fault, or told again by the caller.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  if (is_device(source)) return open_v4l2(source, settings);
  const std::string unheeded = driver_settings(settings);
  if (!unheeded.empty()) {
    throw InputError(source + ": " + unheeded + " can be set for /dev/videoN only; " +
                     "here say it in the pipeline, or to the camera");
  }
  if (starts_with(source, kPipelinePrefix)) {
    return open_pipeline(source, source.substr(kPipelinePrefix.size()), settings.raw_depth);
  }
  return std::make_unique<VideoReader>(open_stream(source));
}

std::string camera_abilities(const std::string& source) {
  return is_device(source) ? v4l2_abilities(source) : "";
}

}  // namespace limbcast
