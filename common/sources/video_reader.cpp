#include "common/sources/video_reader.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>
#include <utility>
#include <vector>

#include "common/config/log.hpp"
#include "common/input_error.hpp"
#include "common/sources/capture_time.hpp"

namespace limbcast {
namespace {

const std::string kPipelinePrefix = "gst:";

bool starts_with(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

bool is_device(const std::string& source) { return starts_with(source, "/dev/"); }

class VideoReader : public FrameReader {
 public:
  explicit VideoReader(const cv::VideoCapture& capture)
      : capture_(capture), has_driver_stamp_(capture_.getBackendName() == "V4L2") {}

  std::optional<CapturedFrame> read() override {
    CapturedFrame frame;
    if (!capture_.read(frame.pixels) || frame.pixels.empty()) return std::nullopt;
    const Clocks now = read_clocks();
    frame.utime = now.utime;
    if (has_driver_stamp_) {
      const double driver_ms = capture_.get(cv::CAP_PROP_POS_MSEC);
      frame.utime = capture_utime(std::llround(1000.0 * driver_ms), now);
    }
    // The capture reuses its buffer for the next frame.
    frame.pixels = frame.pixels.clone();
    return frame;
  }

 private:
  cv::VideoCapture capture_;
  bool has_driver_stamp_;
};

void check_device(const std::string& device) {
  const int file = ::open(device.c_str(), O_RDWR | O_NONBLOCK);
  if (file >= 0) {
    ::close(file);
    return;
  }
  const std::string advice = errno == EACCES ? "add the user to the group video"
                             : errno == EBUSY
                                 ? "end the program that uses it"
                                 : "is the camera plugged in? See v4l2-ctl --list-devices";
  throw InputError(device + ": " + std::strerror(errno) + "; " + advice);
}

/// What of the settings a driver alone can do, for messages; empty: nothing.
std::string driver_settings(const CameraSettings& settings) {
  std::string names;
  const auto add = [&](bool wanted, const char* name) {
    if (wanted) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  add(settings.width > 0, "camera-width");
  add(settings.height > 0, "camera-height");
  add(settings.rate_hz > 0.0, "camera-rate");
  add(std::isfinite(settings.exposure), "exposure");
  add(std::isfinite(settings.gain), "gain");
  return names;
}

/// Returns the names of what the driver refused.
std::vector<std::string> apply(const CameraSettings& settings, cv::VideoCapture& capture) {
  std::vector<std::string> refused;
  const auto set = [&](const char* name, int property, double value) {
    if (!capture.set(property, value)) refused.emplace_back(name);
  };
  if (settings.width > 0) set("camera-width", cv::CAP_PROP_FRAME_WIDTH, settings.width);
  if (settings.height > 0) set("camera-height", cv::CAP_PROP_FRAME_HEIGHT, settings.height);
  if (settings.rate_hz > 0.0) set("camera-rate", cv::CAP_PROP_FPS, settings.rate_hz);
  if (std::isfinite(settings.exposure)) {
    constexpr double kManualExposure = 1.0;  // V4L2_EXPOSURE_MANUAL
    capture.set(cv::CAP_PROP_AUTO_EXPOSURE, kManualExposure);
    set("exposure", cv::CAP_PROP_EXPOSURE, settings.exposure);
  }
  if (std::isfinite(settings.gain)) set("gain", cv::CAP_PROP_GAIN, settings.gain);
  if (settings.raw_depth) capture.set(cv::CAP_PROP_CONVERT_RGB, 0.0);
  // The driver's queue must not hold old frames.
  capture.set(cv::CAP_PROP_BUFFERSIZE, 2.0);
  return refused;
}

cv::VideoCapture open_device(const std::string& device, const CameraSettings& settings) {
  check_device(device);
  // OpenCV waits 10 s for a frame that does not come; a stalled camera is to be opened again
  // earlier.
  setenv("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", "2", 0);
  cv::VideoCapture capture(device, cv::CAP_V4L2);
  if (!capture.isOpened()) {
    throw InputError(
        device + ": gives no pictures; is it a camera's first device? See v4l2-ctl --list-devices");
  }
  for (const std::string& setting : apply(settings, capture))
    config::log(config::LogLevel::kWarning, device + ": refuses '" + setting +
                                                "'; what it takes: v4l2-ctl -d " + device +
                                                " --list-ctrls --list-formats-ext");
  return capture;
}

cv::VideoCapture open_pipeline(const std::string& pipeline, bool raw_depth) {
  std::string whole = pipeline;
  if (pipeline.find("appsink") == std::string::npos) {
    // A conversion would take depth for grey values and drop half of their bits.
    if (!raw_depth) whole += " ! videoconvert ! video/x-raw,format=(string){BGR,GRAY8}";
    whole += " ! appsink max-buffers=2 drop=true sync=false";
  }
  cv::VideoCapture capture(whole, cv::CAP_GSTREAMER);
  if (!capture.isOpened()) {
    throw InputError("gst:" + pipeline +
                     ": cannot be started; try it with gst-launch-1.0 and a sink");
  }
  return capture;
}

cv::VideoCapture open_stream(const std::string& url) {
  cv::VideoCapture capture(url, cv::CAP_FFMPEG);
  if (!capture.isOpened()) throw InputError(url + ": cannot be opened; is it sending?");
  return capture;
}

/// "; name from smallest to largest" of a control that the device has; else empty.
std::string describe_control(int file, std::uint32_t id, const std::string& name) {
  v4l2_queryctrl control{};
  control.id = id;
  if (ioctl(file, VIDIOC_QUERYCTRL, &control) != 0) return "";
  return "; " + name + " " + std::to_string(control.minimum) + " to " +
         std::to_string(control.maximum);
}

std::string describe_format(int file, v4l2_fmtdesc& format) {
  std::string text = reinterpret_cast<const char*>(format.description);
  v4l2_frmsizeenum size{};
  size.pixel_format = format.pixelformat;
  for (; ioctl(file, VIDIOC_ENUM_FRAMESIZES, &size) == 0; ++size.index) {
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) return text + " any size";
    text += " " + std::to_string(size.discrete.width) + "x" + std::to_string(size.discrete.height);
  }
  return text;
}

}  // namespace

bool is_camera(const std::string& source) {
  return is_device(source) || starts_with(source, kPipelinePrefix) ||
         source.find("://") != std::string::npos;
}

std::unique_ptr<FrameReader> open_camera(const std::string& source,
                                         const CameraSettings& settings) {
  // What OpenCV warns of is no fault, or told again by the caller.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  if (is_device(source)) return std::make_unique<VideoReader>(open_device(source, settings));
  const std::string unheeded = driver_settings(settings);
  if (!unheeded.empty()) {
    throw InputError(source + ": " + unheeded + " can be set for /dev/videoN only; " +
                     "here say it in the pipeline, or to the camera");
  }
  if (starts_with(source, kPipelinePrefix)) {
    return std::make_unique<VideoReader>(
        open_pipeline(source.substr(kPipelinePrefix.size()), settings.raw_depth));
  }
  return std::make_unique<VideoReader>(open_stream(source));
}

std::string camera_abilities(const std::string& source) {
  const int file = is_device(source) ? ::open(source.c_str(), O_RDWR | O_NONBLOCK) : -1;
  if (file < 0) return "";
  std::string text;
  v4l2_capability capability{};
  if (ioctl(file, VIDIOC_QUERYCAP, &capability) == 0) {
    text = reinterpret_cast<const char*>(capability.card);
  }
  v4l2_fmtdesc format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; ioctl(file, VIDIOC_ENUM_FMT, &format) == 0; ++format.index) {
    text += "; " + describe_format(file, format);
  }
  text += describe_control(file, V4L2_CID_EXPOSURE_ABSOLUTE, "exposure");
  text += describe_control(file, V4L2_CID_GAIN, "gain");
  ::close(file);
  return text;
}

}  // namespace limbcast
