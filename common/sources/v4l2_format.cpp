#include "common/sources/v4l2_format.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "common/input_error.hpp"

namespace limbcast {
namespace {

struct Layout {
  std::uint32_t fourcc;
  PixelLayout layout;
  int type;       ///< of the picture's matrix
  int half_rows;  ///< of the matrix for two rows of the picture: colours may follow below
};

/// The first is preferred among equals: the more colour it keeps, the better.
constexpr std::array<Layout, 7> kLayouts = {{
    {V4L2_PIX_FMT_BGR24, PixelLayout::kPlain, CV_8UC3, 2},
    {V4L2_PIX_FMT_RGB24, PixelLayout::kRgb, CV_8UC3, 2},
    {V4L2_PIX_FMT_YUYV, PixelLayout::kYuyv, CV_8UC2, 2},
    {V4L2_PIX_FMT_UYVY, PixelLayout::kUyvy, CV_8UC2, 2},
    {V4L2_PIX_FMT_NV12, PixelLayout::kNv12, CV_8UC1, 3},
    {V4L2_PIX_FMT_YUV420, PixelLayout::kYuv420, CV_8UC1, 3},
    {V4L2_PIX_FMT_GREY, PixelLayout::kPlain, CV_8UC1, 2},
}};
constexpr std::array<Layout, 2> kDepthLayouts = {{
    {V4L2_PIX_FMT_Z16, PixelLayout::kPlain, CV_16UC1, 2},
    {V4L2_PIX_FMT_Y16, PixelLayout::kPlain, CV_16UC1, 2},
}};
constexpr std::array<std::uint32_t, 2> kJpegs = {V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_JPEG};

/// All that can be read, the preferred first.
std::vector<std::uint32_t> preferred(bool depth) {
  std::vector<std::uint32_t> fourccs;
  if (depth) {
    for (const Layout& layout : kDepthLayouts) fourccs.push_back(layout.fourcc);
    return fourccs;
  }
  for (const Layout& layout : kLayouts) {
    if (layout.fourcc != V4L2_PIX_FMT_GREY) fourccs.push_back(layout.fourcc);
  }
  fourccs.insert(fourccs.end(), kJpegs.begin(), kJpegs.end());
  fourccs.push_back(V4L2_PIX_FMT_GREY);
  return fourccs;
}

const Layout* layout_of(std::uint32_t fourcc) {
  const auto is_it = [fourcc](const Layout& layout) { return layout.fourcc == fourcc; };
  const auto* image = std::find_if(kLayouts.begin(), kLayouts.end(), is_it);
  if (image != kLayouts.end()) return image;
  const auto* depth = std::find_if(kDepthLayouts.begin(), kDepthLayouts.end(), is_it);
  return depth != kDepthLayouts.end() ? depth : nullptr;
}

std::optional<Picture> jpeg_from(const std::uint8_t* bytes, std::size_t num_bytes, int width,
                                 int height) {
  try {
    Picture picture;
    picture.jpeg = identify_image({bytes, bytes + num_bytes}, "picture");
    if (picture.jpeg->width != width || picture.jpeg->height != height) return std::nullopt;
    return picture;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::uint32_t fourcc_of(const std::string& name) {
  std::string padded = name;
  padded.resize(4, ' ');
  return v4l2_fourcc(padded[0], padded[1], padded[2], padded[3]);
}

std::string name_of(std::uint32_t fourcc) {
  std::string name;
  for (int shift = 0; shift < 32; shift += 8) name += static_cast<char>(fourcc >> shift & 0x7FU);
  return name.substr(0, name.find_last_not_of(' ') + 1);
}

bool is_readable(std::uint32_t fourcc, bool depth) {
  const std::vector<std::uint32_t> fourccs = preferred(depth);
  return std::find(fourccs.begin(), fourccs.end(), fourcc) != fourccs.end();
}

std::string readable_formats(bool depth) {
  std::string names;
  for (const std::uint32_t fourcc : preferred(depth)) {
    names += (names.empty() ? "" : ", ") + name_of(fourcc);
  }
  return names;
}

std::optional<std::uint32_t> choose_format(const std::vector<OfferedFormat>& offered,
                                           double wanted_hz, bool depth) {
  std::optional<std::uint32_t> best;
  std::pair<bool, double> best_rank;
  for (const std::uint32_t fourcc : preferred(depth)) {
    for (const OfferedFormat& format : offered) {
      if (format.fourcc != fourcc) continue;
      const double rate_hz =
          format.fastest_hz > 0.0 ? std::min(format.fastest_hz, wanted_hz) : wanted_hz;
      const std::pair rank(format.has_size, rate_hz);
      if (best && rank <= best_rank) continue;
      best = fourcc;
      best_rank = rank;
    }
  }
  return best;
}

std::optional<Picture> picture_from(const std::uint8_t* bytes, std::size_t num_bytes,
                                    const v4l2_pix_format& format) {
  const auto width = static_cast<int>(format.width);
  const auto height = static_cast<int>(format.height);
  const Layout* layout = layout_of(format.pixelformat);
  if (layout == nullptr) return jpeg_from(bytes, num_bytes, width, height);
  const int rows = height * layout->half_rows / 2;
  const std::size_t packed = format.width * CV_ELEM_SIZE(layout->type);
  const std::size_t step = std::max<std::size_t>(format.bytesperline, packed);
  if (num_bytes < step * static_cast<std::size_t>(rows)) return std::nullopt;
  // The device fills the buffer again: the pixels are copied.
  Picture picture;
  picture.pixels =
      cv::Mat(rows, width, layout->type, const_cast<std::uint8_t*>(bytes), step).clone();
  picture.layout = layout->layout;
  return picture;
}

}  // namespace limbcast
