#pragma once

#include <limbcast/stereo_images_t.hpp>

#include "common/camera/images.hpp"

namespace limbcast::lcm_io {

/// Coding of images that are not files already.
enum class ImageCoding { kJpeg, kPng, kRaw };

stereo_images_t to_message(const StereoImages& images, ImageCoding coding, int jpeg_quality);
/// Throws MessageError unless both images are there, 8 bit and of equal size.
StereoImages from_message(const stereo_images_t& message);

}  // namespace limbcast::lcm_io
