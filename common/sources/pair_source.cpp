#include "common/sources/pair_source.hpp"

#include "common/formatted.hpp"
#include "common/input_error.hpp"

namespace limbcast {
namespace {

/// A width and height of 0 stand for any size.
void check_size(int width, int height, const EncodedImage& image, const std::string& name,
                const std::string& where) {
  const bool any = width == 0 && height == 0;
  if (any || (image.width == width && image.height == height)) return;
  throw InputError(where + ": the " + name + " image is " + size_text(image.width, image.height) +
                   ", the calibration is for " + size_text(width, height) +
                   "; give the calibration of this camera and image size");
}

}  // namespace

void check_pair(const PairFormat& format, const EncodedImage& first, const EncodedImage& second,
                const std::string& where) {
  const bool second_alone = first.empty() && format.first_is_optional;
  if (!second_alone) {
    check_size(format.width, format.height, first, format.names.first, where);
  }
  if (format.second_width > 0) {
    check_size(format.second_width, format.second_height, second, format.names.second, where);
  } else if (second_alone) {
    check_size(format.width, format.height, second, format.names.second, where);
  } else if (first.width != second.width || first.height != second.height) {
    throw InputError(where + ": the " + format.names.first + " image is " +
                     size_text(first.width, first.height) + ", the " + format.names.second +
                     " one " + size_text(second.width, second.height) +
                     "; both must be of equal size");
  }
  check_8_bit(first, where + ": the " + format.names.first + " image");
  if (!format.second_is_depth)
    check_8_bit(second, where + ": the " + format.names.second + " image");
  if (format.second_is_depth && (second.bits != 16 || second.channels != 1)) {
    throw InputError(where + ": the depth image has " + std::to_string(second.channels) +
                     " channels of " + std::to_string(second.bits) +
                     " bit; one of 16 bit is needed (PNG, GRAY16_LE or Z16)");
  }
}

EncodedImage coded_for_sending(EncodedImage image, int jpeg_quality, const std::string& where) {
  if (image.empty()) return image;
  const bool is_depth = image.bits == 16 && image.channels == 1;
  if (image.format == ImageFormat::kJpeg || is_depth || (jpeg_quality == 0 && image.bits == 8)) {
    return image;
  }
  return coded_for_sending(decode_image(image, where), jpeg_quality);
}

EncodedImage coded_for_sending(const cv::Mat& pixels, int jpeg_quality) {
  if (pixels.empty()) return {};
  if (pixels.depth() == CV_16U || jpeg_quality == 0) return encode_png(pixels);
  return encode_jpeg(pixels, jpeg_quality);
}

void apply_mounting(const Mounting& option, const Mounting& calibration, Gravity& gravity) {
  if (option.down) {
    gravity.down = option.down->cast<float>();
    gravity.source = GravitySource::kOption;
  } else if (gravity.source != GravitySource::kRecording && calibration.down) {
    gravity.down = calibration.down->cast<float>();
    gravity.source = GravitySource::kOption;
  }
  const std::optional<double> height_m =
      option.sensor_height_m ? option.sensor_height_m : calibration.sensor_height_m;
  if (height_m) gravity.sensor_height_m = static_cast<float>(*height_m);
}

}  // namespace limbcast
