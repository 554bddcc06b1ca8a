#pragma once

#include <fstream>
#include <opencv2/core.hpp>
#include <string>

#include "common/camera/encoded_image.hpp"
#include "common/sources/pair_source.hpp"

namespace limbcast::test {

inline void write_bytes(const std::string& path, const EncodedImage& image) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(image.bytes.data()),
             static_cast<std::streamsize>(image.bytes.size()));
}

/// A picture of one grey level.
inline cv::Mat grey_picture(int width, int height, int level) {
  return {height, width, CV_8UC3, cv::Scalar::all(level)};
}

/// Grey level of such a picture after coding.
inline int level_of(const EncodedImage& image) {
  return decode_image(image, "test").at<cv::Vec3b>(10, 10)[0];
}

inline PairFormat stereo_format(int width = 64, int height = 48) {
  return {{"left", "right"}, false, width, height, "front", "front/left_rectified", 95};
}

inline PairFormat depth_format(int width = 64, int height = 48) {
  return {{"color", "depth"}, true, width, height, "rgbd", "rgbd/color_optical", 95};
}

}  // namespace limbcast::test
