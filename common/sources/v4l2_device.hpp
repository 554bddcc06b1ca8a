#pragma once

#include <linux/videodev2.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <initializer_list>
#include <string>
#include <vector>

#include "common/sources/v4l2_format.hpp"

namespace limbcast {

/// An open V4L2 device, closed at the end.
class V4l2Device {
 public:
  /// Opens it; where that fails is_open() is false and errno tells why.
  explicit V4l2Device(const std::string& path);
  ~V4l2Device();
  V4l2Device(const V4l2Device&) = delete;
  V4l2Device& operator=(const V4l2Device&) = delete;

  bool is_open() const { return file_ >= 0; }
  int file() const { return file_; }
  /// False: errno tells why.
  template <class Argument>
  bool ask(unsigned long request, Argument& argument) const {
    while (true) {
      if (ioctl(file_, request, &argument) == 0) return true;
      if (errno != EINTR) return false;
    }
  }
  /// What it offers at a size [px].
  std::vector<OfferedFormat> offers(std::uint32_t width, std::uint32_t height) const;

 private:
  int file_;
};

/// A control of a device: exposure, gain.
class V4l2Control {
 public:
  /// The first of `ids` that the device has.
  V4l2Control(const V4l2Device& device, std::initializer_list<std::uint32_t> ids);
  static V4l2Control exposure(const V4l2Device& device);
  static V4l2Control gain(const V4l2Device& device);

  /// "0 to 255"; empty: the device does not have it.
  std::string range() const;
  /// False: the device did not take the value.
  bool set(double value) const;

 private:
  const V4l2Device& device_;
  v4l2_queryctrl query_{};
  bool exists_ = false;
};

/// Frames a second of a period; 0: none is told.
double rate_of(const v4l2_fract& period);

/// For the log at start: the device's name, formats, sizes, exposure and gain; empty where it
/// cannot be asked.
std::string v4l2_abilities(const std::string& path);

}  // namespace limbcast
