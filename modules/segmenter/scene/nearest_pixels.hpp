#pragma once

#include <cstddef>
#include <functional>
#include <opencv2/core.hpp>

namespace limbcast::segmenter {

/// Calls `fill(pixel, nearest)` for each pixel without a value that has one with a value at most
/// `radius_px` away. `empty`: 0 where there is a value; pixels are counted row by row.
void fill_from_nearest(const cv::Mat1b& empty, int radius_px,
                       const std::function<void(std::size_t pixel, std::size_t nearest)>& fill);

}  // namespace limbcast::segmenter
