#include "common/sources/v4l2_camera.hpp"

#include <poll.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "common/config/log.hpp"
#include "common/formatted.hpp"
#include "common/input_error.hpp"
#include "common/sources/capture_time.hpp"
#include "common/sources/v4l2_device.hpp"
#include "common/units.hpp"

namespace limbcast {
namespace {

/// Two are filled while one is read; one more for a computer that is busy.
constexpr std::uint32_t kBuffers = 4;
/// A device that gives nothing for so long is opened again: that wakes some that hang.
constexpr int kSilence_ms = 5000;
/// A rate that differs by less from the one asked for is the same (30 and 29.97 frames/s).
constexpr double kSameRate = 0.01;

std::string advice_for(int error) {
  switch (error) {
    case EACCES:
    case EPERM:
      return "add the user to the group video";
    case EBUSY:
      return "end the program that uses it";
    case ENOSPC:
      return "the USB bus is full: ask for motion JPEG, a smaller picture or rate (camera-format, "
             "camera-width, camera-rate), or plug one camera into another bus";
    default:
      return "is the camera plugged in? See v4l2-ctl --list-devices (package v4l-utils)";
  }
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw InputError(path + ": " + std::strerror(error) + "; " + advice_for(error));
}

[[noreturn]] void fail_as_no_camera(const std::string& path) {
  throw InputError(path +
                   ": gives no pictures; is it a camera's first device? See v4l2-ctl "
                   "--list-devices");
}

/// Memory that the driver fills.
class Buffer {
 public:
  Buffer(const V4l2Device& device, const v4l2_buffer& buffer)
      : size_(buffer.length),
        bytes_(mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, device.file(),
                    buffer.m.offset)) {}
  ~Buffer() {
    if (is_mapped()) munmap(bytes_, size_);
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  bool is_mapped() const { return bytes_ != MAP_FAILED; }
  const std::uint8_t* bytes() const { return static_cast<const std::uint8_t*>(bytes_); }
  std::size_t size() const { return size_; }

 private:
  std::size_t size_;
  void* bytes_;
};

v4l2_buffer capture_buffer(std::uint32_t index = 0) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

class V4l2Camera : public FrameReader {
 public:
  V4l2Camera(std::string path, const CameraSettings& settings)
      : path_(std::move(path)), settings_(settings), device_(path_) {
    if (!device_.is_open()) fail(path_, errno);
    require_camera();
    set_format();
    set_rate();
    set_controls();
    map_buffers();
    start();
  }
  /// "YUYV 640x480 at 30 frames/s".
  std::string mode() const {
    return name_of(format_.pixelformat) + " " + size_text(format_.width, format_.height) +
           (rate_hz_ > 0.0 ? " at " + formatted("%.4g", rate_hz_) + " frames/s" : "");
  }

  std::optional<CapturedFrame> read() override {
    while (true) {
      v4l2_buffer buffer = capture_buffer();
      if (!wait_for(buffer)) return std::nullopt;
      const Clocks now = read_clocks();
      const std::int64_t driver_us =
          buffer.timestamp.tv_sec * kMicrosecondsPerSecond<std::int64_t> + buffer.timestamp.tv_usec;
      std::optional<Picture> picture = picture_in(buffer);
      if (!device_.ask(VIDIOC_QBUF, buffer)) return std::nullopt;
      // A damaged picture is left out, and the next one awaited.
      if (picture) return CapturedFrame{capture_utime(driver_us, now), std::move(*picture)};
    }
  }

 private:
  void warn(const std::string& text) const {
    config::log(config::LogLevel::kWarning, path_ + ": " + text);
  }
  void refuse(const std::string& setting) const {
    warn("refuses '" + setting + "'; what it takes: v4l2-ctl -d " + path_ +
         " --list-ctrls --list-formats-ext");
  }

  void require_camera() const {
    v4l2_capability capability{};
    if (!device_.ask(VIDIOC_QUERYCAP, capability)) fail_as_no_camera(path_);
    const std::uint32_t abilities = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0
                                        ? capability.device_caps
                                        : capability.capabilities;
    constexpr std::uint32_t kNeeded = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
    if ((abilities & kNeeded) != kNeeded) fail_as_no_camera(path_);
  }

  [[noreturn]] void fail_as_unreadable(const std::string& formats) const {
    throw InputError(path_ + ": gives " + formats + ", one of " +
                     readable_formats(settings_.raw_depth) +
                     " is needed; see whether another device of the camera has it: v4l2-ctl "
                     "--list-devices");
  }

  std::uint32_t wanted_fourcc(std::uint32_t width, std::uint32_t height) const {
    const std::vector<OfferedFormat> offers = device_.offers(width, height);
    if (offers.empty()) fail_as_no_camera(path_);
    if (!settings_.format.empty()) {
      const std::uint32_t fourcc = fourcc_of(settings_.format);
      const bool offered =
          std::any_of(offers.begin(), offers.end(),
                      [fourcc](const OfferedFormat& offer) { return offer.fourcc == fourcc; });
      if (offered && is_readable(fourcc, settings_.raw_depth)) return fourcc;
      refuse("camera-format");
    }
    const auto best = choose_format(offers, wanted_hz(), settings_.raw_depth);
    if (best) return *best;
    std::string names;
    for (const OfferedFormat& offer : offers) {
      names += (names.empty() ? "" : ", ") + name_of(offer.fourcc);
    }
    fail_as_unreadable(names);
  }

  void set_format() {
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (!device_.ask(VIDIOC_G_FMT, format)) fail_as_no_camera(path_);
    v4l2_pix_format& pixels = format.fmt.pix;
    const auto wanted = [](std::uint32_t own, int asked, int calibrated) {
      const int size_px = asked > 0 ? asked : calibrated;
      return size_px > 0 ? static_cast<std::uint32_t>(size_px) : own;
    };
    const std::uint32_t width = wanted(pixels.width, settings_.width, settings_.calibrated_width);
    const std::uint32_t height =
        wanted(pixels.height, settings_.height, settings_.calibrated_height);
    pixels.width = width;
    pixels.height = height;
    pixels.pixelformat = wanted_fourcc(width, height);
    pixels.field = V4L2_FIELD_ANY;
    pixels.bytesperline = 0;
    pixels.sizeimage = 0;
    if (!device_.ask(VIDIOC_S_FMT, format)) fail(path_, errno);
    format_ = pixels;
    // Drivers may take the nearest instead of what was asked.
    if (!is_readable(pixels.pixelformat, settings_.raw_depth)) {
      fail_as_unreadable(name_of(pixels.pixelformat));
    }
    if (pixels.width != width || pixels.height != height) {
      warn("gives " + size_text(pixels.width, pixels.height) + " instead of " +
           size_text(width, height) + "; what it has: v4l2-ctl -d " + path_ +
           " --list-formats-ext");
    }
  }

  double wanted_hz() const { return settings_.rate_hz > 0.0 ? settings_.rate_hz : kUsualRate_hz; }

  void set_rate() {
    v4l2_streamparm parameters{};
    parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    v4l2_captureparm& capture = parameters.parm.capture;
    const auto period_us = static_cast<std::uint32_t>(std::lround(1e6 / wanted_hz()));
    capture.timeperframe = {period_us, kMicrosecondsPerSecond<std::uint32_t>};
    if (device_.ask(VIDIOC_S_PARM, parameters)) rate_hz_ = rate_of(capture.timeperframe);
    const bool same = std::abs(rate_hz_ - wanted_hz()) <= kSameRate * wanted_hz();
    if (settings_.rate_hz > 0.0 && !same) refuse("camera-rate");
  }

  /// What the camera regulates by itself does not keep a value.
  void set_controls() const {
    if (std::isfinite(settings_.exposure)) {
      V4l2Control(device_, {V4L2_CID_EXPOSURE_AUTO}).set(V4L2_EXPOSURE_MANUAL);
      if (!V4l2Control::exposure(device_).set(settings_.exposure)) refuse("exposure");
    }
    if (std::isfinite(settings_.gain)) {
      V4l2Control(device_, {V4L2_CID_AUTOGAIN}).set(0.0);
      if (!V4l2Control::gain(device_).set(settings_.gain)) refuse("gain");
    }
  }

  void map_buffers() {
    v4l2_requestbuffers request{};
    request.count = kBuffers;
    request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    request.memory = V4L2_MEMORY_MMAP;
    if (!device_.ask(VIDIOC_REQBUFS, request)) fail(path_, errno);
    for (std::uint32_t i = 0; i < request.count; ++i) {
      v4l2_buffer buffer = capture_buffer(i);
      if (!device_.ask(VIDIOC_QUERYBUF, buffer)) fail(path_, errno);
      buffers_.push_back(std::make_unique<Buffer>(device_, buffer));
      if (!buffers_.back()->is_mapped()) fail(path_, errno);
      if (!device_.ask(VIDIOC_QBUF, buffer)) fail(path_, errno);
    }
  }

  /// Closing the device stops it again.
  void start() const {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (!device_.ask(VIDIOC_STREAMON, type)) fail(path_, errno);
  }

  /// False: the device failed, was unplugged or is silent.
  bool wait_for(v4l2_buffer& buffer) const {
    while (true) {
      if (device_.ask(VIDIOC_DQBUF, buffer)) return true;
      if (errno != EAGAIN) return false;
      pollfd ready{device_.file(), POLLIN, 0};
      const int events = poll(&ready, 1, kSilence_ms);
      if (events == 0 || (events < 0 && errno != EINTR)) return false;
      if (events > 0 && (ready.revents & (POLLERR | POLLHUP)) != 0) return false;
    }
  }

  std::optional<Picture> picture_in(const v4l2_buffer& buffer) const {
    if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 || buffer.index >= buffers_.size()) {
      return std::nullopt;
    }
    const Buffer& filled = *buffers_[buffer.index];
    return picture_from(filled.bytes(), std::min<std::size_t>(buffer.bytesused, filled.size()),
                        format_);
  }

  const std::string path_;
  const CameraSettings settings_;
  const V4l2Device device_;
  v4l2_pix_format format_{};
  double rate_hz_ = 0.0;  ///< 0: the device does not tell
  std::vector<std::unique_ptr<Buffer>> buffers_;
};

}  // namespace

std::unique_ptr<FrameReader> open_v4l2(const std::string& path, const CameraSettings& settings) {
  auto camera = std::make_unique<V4l2Camera>(path, settings);
  config::log(config::LogLevel::kInfo, path + ": gives " + camera->mode());
  return camera;
}

}  // namespace limbcast
