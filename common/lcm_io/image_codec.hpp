#pragma once

#include <limbcast/image_t.hpp>
#include <opencv2/core/mat.hpp>
#include <string>

#include "common/camera/encoded_image.hpp"

namespace limbcast::lcm_io {

/// 8-bit grey or BGR image as JPEG of that quality (1 to 100); an empty image gives a 0 x 0
/// message.
image_t to_jpeg_message(const cv::Mat& image, int quality);
/// Any image as PNG: lossless, 8 or 16 bit.
image_t to_png_message(const cv::Mat& image);
/// 8-bit grey or BGR image, rows as they are.
image_t to_raw_message(const cv::Mat& image);
/// A JPEG or PNG as it is: nothing is lost and no time is spent.
image_t to_message(const EncodedImage& image);

/// The image: empty for 0 x 0, 8-bit grey or BGR, or 16-bit grey. Throws MessageError where size,
/// encoding or data do not fit together.
cv::Mat from_message(const image_t& message);

}  // namespace limbcast::lcm_io
