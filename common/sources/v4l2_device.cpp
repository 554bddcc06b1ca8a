#include "common/sources/v4l2_device.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/formatted.hpp"

namespace limbcast {
namespace {

/// All that the device can tell of one kind, asked with a rising index.
template <class Entry>
std::vector<Entry> list(const V4l2Device& device, unsigned long request, Entry entry) {
  std::vector<Entry> entries;
  for (; device.ask(request, entry); ++entry.index) entries.push_back(entry);
  return entries;
}

std::vector<v4l2_fmtdesc> formats_of(const V4l2Device& device) {
  v4l2_fmtdesc format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  return list(device, VIDIOC_ENUM_FMT, format);
}

std::vector<v4l2_frmsizeenum> sizes_of(const V4l2Device& device, std::uint32_t fourcc) {
  v4l2_frmsizeenum size{};
  size.pixel_format = fourcc;
  return list(device, VIDIOC_ENUM_FRAMESIZES, size);
}

bool has_size(const v4l2_frmsizeenum& size, std::uint32_t width, std::uint32_t height) {
  if (size.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
    return size.discrete.width == width && size.discrete.height == height;
  }
  return width >= size.stepwise.min_width && width <= size.stepwise.max_width &&
         height >= size.stepwise.min_height && height <= size.stepwise.max_height;
}

/// 0: the device does not tell.
double fastest_hz(const V4l2Device& device, std::uint32_t fourcc, std::uint32_t width,
                  std::uint32_t height) {
  v4l2_frmivalenum interval{};
  interval.pixel_format = fourcc;
  interval.width = width;
  interval.height = height;
  double fastest = 0.0;
  for (const v4l2_frmivalenum& entry : list(device, VIDIOC_ENUM_FRAMEINTERVALS, interval)) {
    const bool discrete = entry.type == V4L2_FRMIVAL_TYPE_DISCRETE;
    fastest = std::max(fastest, rate_of(discrete ? entry.discrete : entry.stepwise.min));
    // Further entries of a range would be the same again.
    if (!discrete) break;
  }
  return fastest;
}

OfferedFormat offered(const V4l2Device& device, std::uint32_t fourcc, std::uint32_t width,
                      std::uint32_t height) {
  const std::vector<v4l2_frmsizeenum> sizes = sizes_of(device, fourcc);
  const bool fits = sizes.empty() || std::any_of(sizes.begin(), sizes.end(), [&](const auto& size) {
                      return has_size(size, width, height);
                    });
  return {fourcc, fits, fastest_hz(device, fourcc, width, height)};
}

std::string describe(const v4l2_frmsizeenum& size) {
  if (size.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
    return size_text(size.discrete.width, size.discrete.height);
  }
  return size_text(size.stepwise.min_width, size.stepwise.min_height) + " to " +
         size_text(size.stepwise.max_width, size.stepwise.max_height);
}

std::string sizes_text(const V4l2Device& device, std::uint32_t fourcc) {
  std::string text;
  for (const v4l2_frmsizeenum& size : sizes_of(device, fourcc)) text += " " + describe(size);
  return text;
}

/// "; YUYV, UYVY 640x480 320x240; MJPG 1280x720": formats of the same sizes stand together.
std::string formats_text(const V4l2Device& device) {
  std::vector<std::pair<std::string, std::string>> groups;
  for (const v4l2_fmtdesc& format : formats_of(device)) {
    const std::string sizes = sizes_text(device, format.pixelformat);
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&sizes](const auto& entry) { return entry.second == sizes; });
    const std::string name = name_of(format.pixelformat);
    if (group == groups.end()) {
      groups.emplace_back(name, sizes);
    } else {
      group->first += ", " + name;
    }
  }
  std::string text;
  for (const auto& [names, sizes] : groups) text += "; " + names + sizes;
  return text;
}

}  // namespace

V4l2Device::V4l2Device(const std::string& path)
    : file_(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)) {}

V4l2Device::~V4l2Device() {
  if (is_open()) ::close(file_);
}

std::vector<OfferedFormat> V4l2Device::offers(std::uint32_t width, std::uint32_t height) const {
  std::vector<OfferedFormat> offers;
  for (const v4l2_fmtdesc& format : formats_of(*this)) {
    offers.push_back(offered(*this, format.pixelformat, width, height));
  }
  return offers;
}

V4l2Control::V4l2Control(const V4l2Device& device, std::initializer_list<std::uint32_t> ids)
    : device_(device) {
  for (const std::uint32_t id : ids) {
    query_.id = id;
    exists_ = device.ask(VIDIOC_QUERYCTRL, query_) && (query_.flags & V4L2_CTRL_FLAG_DISABLED) == 0;
    if (exists_) return;
  }
}

V4l2Control V4l2Control::exposure(const V4l2Device& device) {
  return {device, {V4L2_CID_EXPOSURE_ABSOLUTE, V4L2_CID_EXPOSURE}};
}

V4l2Control V4l2Control::gain(const V4l2Device& device) {
  return {device, {V4L2_CID_GAIN, V4L2_CID_ANALOGUE_GAIN}};
}

std::string V4l2Control::range() const {
  if (!exists_) return "";
  return std::to_string(query_.minimum) + " to " + std::to_string(query_.maximum);
}

bool V4l2Control::set(double value) const {
  v4l2_control control{query_.id, static_cast<std::int32_t>(std::lround(value))};
  const std::int32_t wanted = control.value;
  // Drivers take the nearest value without a word.
  return exists_ && device_.ask(VIDIOC_S_CTRL, control) && device_.ask(VIDIOC_G_CTRL, control) &&
         control.value == wanted;
}

double rate_of(const v4l2_fract& period) {
  return period.numerator == 0 ? 0.0 : static_cast<double>(period.denominator) / period.numerator;
}

std::string v4l2_abilities(const std::string& path) {
  const V4l2Device device(path);
  v4l2_capability capability{};
  if (!device.is_open() || !device.ask(VIDIOC_QUERYCAP, capability)) return "";
  std::string text = reinterpret_cast<const char*>(capability.card) + formats_text(device);
  const auto add = [&text](const std::string& name, const std::string& range) {
    if (!range.empty()) text += "; " + name + " " + range;
  };
  add("exposure", V4l2Control::exposure(device).range());
  add("gain", V4l2Control::gain(device).range());
  return text;
}

}  // namespace limbcast
