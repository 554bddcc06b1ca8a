#pragma once

#include <opencv2/core/mat.hpp>

namespace limbcast::reconstructor {

/// What a stereo matcher found, for each pixel of the rectified left image.
struct DisparityImage {
  cv::Mat1f disparity_px;  ///< column in the left minus column in the right image; 0 = none
  cv::Mat1b confidence;    ///< 0 = none ... 255 = no other disparity comes near
};

}  // namespace limbcast::reconstructor
