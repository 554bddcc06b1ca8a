#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace limbcast::calibrate {

/// Writes a picture in the format of the path's ending. Throws config::UsageError for an ending
/// that is no picture's, std::runtime_error where it cannot be written.
void write_picture(const std::string& path, const cv::Mat& image);

/// Writes a PNG that tells its resolution, so that it is printed in true size. Throws
/// std::runtime_error where it cannot be written.
void write_png_of_size(const std::string& path, const cv::Mat& image, double pixels_per_m);

}  // namespace limbcast::calibrate
