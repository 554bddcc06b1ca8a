#pragma once

#include <opencv2/core/mat.hpp>

#include "modules/reconstructor/disparity.hpp"
#include "modules/reconstructor/gaps.hpp"
#include "modules/reconstructor/image_noise.hpp"
#include "modules/reconstructor/semi_global.hpp"
#include "modules/reconstructor/silhouettes.hpp"
#include "modules/reconstructor/speckles.hpp"
#include "modules/reconstructor/subpixel.hpp"

namespace limbcast::reconstructor {

struct MatcherParams {
  ImageNoiseParams noise;
  SemiGlobalParams semi_global;
  SpeckleParams speckles;
  SilhouetteParams silhouettes;
  GapParams gaps;
  SubpixelParams subpixel;
};

/// Disparities of the left image of a rectified pair. Both images 8-bit, BGR or grey, of one size.
/// Where more than `kMaxDisparities` are asked for, the images are matched so many times smaller
/// that these suffice.
DisparityImage match(const cv::Mat& left, const cv::Mat& right, const MatcherParams& params = {});

}  // namespace limbcast::reconstructor
