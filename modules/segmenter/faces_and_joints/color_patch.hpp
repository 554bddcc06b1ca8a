#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "common/cloud/cloud.hpp"

namespace limbcast::segmenter {

/// A square of an image that stands upright by gravity.
struct UprightSquare {
  Eigen::Vector2f center_px;
  Eigen::Vector2f down;  ///< unit vector in the image
  float side_px;
};

/// View of an organised cloud's colours, to be read only.
cv::Mat3b color_image(const Cloud& cloud);

/// From the pixels of a patch that is `patch_px` wide to those of the image that it is cut out of.
Eigen::Affine2f image_from_patch(const UprightSquare& square, int patch_px);

/// What the square shows, as a patch that is `patch_px` wide; `outside` tells of its parts beyond
/// the image.
cv::Mat3b cut_out(const cv::Mat3b& image, const UprightSquare& square, int patch_px,
                  cv::BorderTypes outside);

/// Fills what `hole` marks (non-zero) smoothly with the colours around it; black where all is hole.
void fill_in(cv::Mat3b& image, const cv::Mat1b& hole);

}  // namespace limbcast::segmenter
