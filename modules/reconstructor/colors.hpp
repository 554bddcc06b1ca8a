#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/cloud/cloud.hpp"

namespace limbcast::reconstructor {

/// Colours of an 8-bit BGR or grey image, row by row; none for an empty image.
/// Throws std::invalid_argument for any other type of image.
std::vector<Bgr> colors_of(const cv::Mat& image);

/// 8-bit grey of an 8-bit BGR or grey image. Throws std::invalid_argument for any other type of
/// image.
cv::Mat1b grey_of(const cv::Mat& image);

/// In grey, `by` times as small.
cv::Mat1b shrunk(const cv::Mat& image, int by);

}  // namespace limbcast::reconstructor
