#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace limbcast::calibrate {

/// A sheet, upright.
struct Paper {
  double width_mm = 0.0, height_mm = 0.0;
};

/// "a4", "a3" (ISO 216) or "letter" (ANSI Y14.1).
Paper paper_of(const std::string& name);

/// Writes an 8-bit grey picture in true size on the middle of one sheet, upright or across as it
/// fits, with a caption at its foot. Throws config::UsageError where the picture is larger than the
/// sheet, std::runtime_error where the file cannot be written.
void write_pdf_of_size(const std::string& path, const cv::Mat& image, double pixels_per_m,
                       const Paper& paper, const std::string& caption);

}  // namespace limbcast::calibrate
