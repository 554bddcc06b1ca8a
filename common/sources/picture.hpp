#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "common/camera/encoded_image.hpp"

namespace limbcast {

/// How the pixels of a picture lie in memory. The YUV ones are V4L2's of the same name.
enum class PixelLayout {
  kPlain,  ///< grey, BGR or 16-bit depth, as everywhere else
  kRgb,
  kYuyv,
  kUyvy,
  kNv12,
  kYuv420,
};

/// A picture as a camera gave it. It is turned into what is sent only when it is sent: most of the
/// work is spared for those that get no partner or are replaced by a newer one.
struct Picture {
  cv::Mat pixels;  ///< empty where the camera coded the picture itself
  PixelLayout layout = PixelLayout::kPlain;
  std::optional<EncodedImage> jpeg = std::nullopt;  ///< of a camera that gives motion JPEG
};

/// Grey, BGR or 16-bit depth. `where` names the camera in errors.
cv::Mat plain_pixels(const Picture& picture, const std::string& where);

/// The picture as it is sent: JPEG as it is, others coded as `jpeg_quality` says.
EncodedImage coded_for_sending(const Picture& picture, int jpeg_quality);

}  // namespace limbcast
