#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace limbcast {

/// JPEG of an 8-bit grey or BGR image, colours at half resolution; `quality` 1 to 100. By
/// libjpeg-turbo as in OpenCV, which spends as long again on turning BGR into RGB and back.
std::vector<std::uint8_t> compress_jpeg(const cv::Mat& image, int quality);

/// Grey or BGR as coded, not turned by notes of how the camera was held; empty where the bytes
/// cannot be decoded, or to another size.
cv::Mat decompress_jpeg(const std::vector<std::uint8_t>& bytes, const cv::Size& size);

}  // namespace limbcast
