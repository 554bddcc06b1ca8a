#include "common/camera/jpeg.hpp"

#include <turbojpeg.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace limbcast {
namespace {

struct Closer {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Handle = std::unique_ptr<void, Closer>;

/// Whether the last picture's data ended before the picture did. Other warnings are of what cameras
/// leave between frames, or of a damaged spot.
bool ended_early(tjhandle handle) {
  return std::string(tjGetErrorStr2(handle)).find("premature end") != std::string::npos;
}

}  // namespace

std::vector<std::uint8_t> compress_jpeg(const cv::Mat& image, int quality) {
  const bool grey = image.channels() == 1;
  const int format = grey ? TJPF_GRAY : TJPF_BGR;
  const int sampling = grey ? TJSAMP_GRAY : TJSAMP_420;
  auto size = tjBufSize(image.cols, image.rows, sampling);
  // Not a vector, which would clear it all: most of it is never written.
  const std::unique_ptr<unsigned char[]> bytes(new unsigned char[size]);
  const Handle handle(tjInitCompress());
  unsigned char* data = bytes.get();
  if (!handle || tjCompress2(handle.get(), image.data, image.cols, static_cast<int>(image.step),
                             image.rows, format, &data, &size, sampling, quality,
                             TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT) != 0)
    throw std::runtime_error(std::string("image cannot be coded as JPEG: ") +
                             tjGetErrorStr2(handle.get()));
  return {data, data + size};
}

cv::Mat decompress_jpeg(const std::vector<std::uint8_t>& bytes, const cv::Size& size) {
  const Handle handle(tjInitDecompress());
  int width = 0, height = 0, sampling = 0, colors = 0;
  const auto num_bytes = static_cast<unsigned long>(bytes.size());
  if (!handle ||
      tjDecompressHeader3(handle.get(), bytes.data(), num_bytes, &width, &height, &sampling,
                          &colors) != 0 ||
      size != cv::Size(width, height))
    return {};
  const bool grey = colors == TJCS_GRAY;
  cv::Mat image(size, grey ? CV_8UC1 : CV_8UC3);
  if (tjDecompress2(handle.get(), bytes.data(), num_bytes, image.data, width,
                    static_cast<int>(image.step), height, grey ? TJPF_GRAY : TJPF_BGR,
                    TJFLAG_ACCURATEDCT) != 0 &&
      (tjGetErrorCode(handle.get()) != TJERR_WARNING || ended_early(handle.get())))
    return {};
  return image;
}

}  // namespace limbcast
