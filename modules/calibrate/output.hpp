#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace limbcast::calibrate {

/// Writes a PNG that tells its resolution, so that it is printed in true size. Throws
/// std::runtime_error where it cannot be written.
void write_png_of_size(const std::string& path, const cv::Mat& image, double pixels_per_m);

}  // namespace limbcast::calibrate
